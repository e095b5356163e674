# SPDX-License-Identifier: MIT
# Completion of limitcheck in fish: what bash would offer.
set -g __limitcheck_bash (path dirname (status filename))/../../bash-completion/completions/limitcheck
function __limitcheck_offers
    bash $__limitcheck_bash (commandline -opc) "$(commandline -ct)"
end
complete -c limitcheck -a '(__limitcheck_offers)'
