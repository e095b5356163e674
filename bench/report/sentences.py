# SPDX-License-Identifier: MIT
"""The sentences that the paper's figures rest on: what the text says, what we conclude, and what was measured. The verdict and
the figures are those of the claims, so that none is judged twice; what concerns time is measured beside them."""
import re

from tables import badge, details, mark, number, table, text

# What a reproduction has to show; the claims that decide it.
SENTENCES = (
    ("T1", "Back faces", ("C77",)),
    ("T2", "Depth by strategy", ("C75",)),
    ("T3", "Uniform against adaptive: triangles", ("C74",)),
    ("T4", "Uniform against adaptive: time", ("C74",)),
    ("T5", "Faces without a partner", ("C41",)),
    ("T6", "Time for a point of the surface", ("C55",)),
    ("T7", "Ten frames per second", ("C78",)),
    ("T8", "Cracks", ("C59", "C60")),
    ("T9", "Where the centre of a fan lies", ("C62",)),
    ("T10", "Adaptive against deep uniform: the picture", ("C79",)),
    ("C31", "What culling takes away", ("C31",)),
    ("C76", "Combined against project-sphere: the picture", ("C76",)),
)
TIMED = ("T4", "T6", "T7")  # rows of timings.json
SIZES = ("200", "800", "2000", "4000")


def by_size(figures):
    """Figures called NAME_FACES as a table: a row for each name, a column for each number of faces; and the others."""
    rows, rest = {}, []
    for name, value in figures.items():
        stem, _, faces = name.rpartition("_")
        if faces in SIZES and stem:
            rows.setdefault(stem, {})[faces] = value
        else:
            rest.append((name, value))
    return {stem: values for stem, values in rows.items() if len(values) > 1}, rest


def figures_of(claim):
    rows, rest = by_size(claim.get("measured") or {})
    plain = lambda name: text(name.replace("_", " "))  # noqa: E731
    sizes = [s for s in SIZES if any(s in values for values in rows.values())]
    tables = []
    if rows:
        tables.append(table(["faces", *sizes], [[plain(stem), *(text(values.get(s, "")) for s in sizes)] for stem, values in rows.items()]))
    if rest:
        tables.append(table(["measured", ""], [[plain(name), text(value)] for name, value in rest]))
    count = len(rows) + len(rest)
    if not tables:
        return ""
    return "".join(tables) if count <= 4 else details(f"All {count} figures that were measured", "".join(tables))


def timed(row):
    kind = {"as the text says": "yes", "not as the text says": "no"}.get(row["outcome"], "open")  # or "depends"
    together = {}  # series over the same quantity are rows of one table
    for s in row["series"]:
        together.setdefault((s["unit"], tuple(s["at"])), []).append([text(s["name"]), *(number(float(v)) for v in s["values"])])
    series = "".join(table([text(unit), *(f"{x:g}" for x in at)], rows) for (unit, at), rows in together.items())
    return f"<p>This run: <b class={kind}>{text(row['outcome'])}</b>. {text(row['figures'])}.</p>{series}"


def sentences(claims, timings):
    by_id = {c["id"]: c for c in claims["claims"]} if claims else {}
    times = {row["id"]: row for row in (timings or {}).get("rows", [])}
    blocks = []
    for name, title, ids in SENTENCES:
        known = [by_id[i] for i in ids if i in by_id]
        body = ""
        for c in known:
            today = mark(c)
            said = " ".join(text(c[key]) for key in ("note", "finding") if c.get(key)) if name not in TIMED else ""
            body += (f"<p><a href='#{c['id']}'>{c['id']}</a>, section {text(c['place'])}: <i>{text(c['statement'])}</i></p>"
                     f"<p>We conclude: {badge(c['verdict'])}; our test: {today}. {said}</p>")
            body += figures_of(c) if name not in TIMED else ""
        if name in times:
            body += timed(times[name])
        if body:
            blocks.append(f"<article id={name}><h3>{name} {text(title)}</h3>{body}</article>")
    load = (timings or {}).get("load")
    if load is not None:
        blocks.append("<p class=origin>Times are processor time, the least of several repetitions; where the repetitions differ by more than "
                      f"what is judged, nothing could be measured. Load of the machine: {number(float(load))}.</p>")
    return "".join(blocks)
