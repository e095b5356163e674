# SPDX-License-Identifier: MIT
"""Passes standard input on to a socket, and what comes from there to standard output."""
import os
import socket
import sys
import threading

connection = socket.socket(socket.AF_UNIX)
connection.connect(sys.argv[1])


def pass_on():
    while data := os.read(0, 1 << 16):
        connection.sendall(data)
    connection.shutdown(socket.SHUT_WR)


threading.Thread(target=pass_on, daemon=True).start()
while data := connection.recv(1 << 16):
    while data:
        data = data[os.write(1, data):]
