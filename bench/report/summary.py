# SPDX-License-Identifier: MIT
"""What a stranger reads first: what this is, what came out, and what the words mean."""
from tables import badge, headline, text

FINDINGS = ("C79", "C74", "C31", "C76", "C16")  # what a reader of the paper would not expect

WORDS = (
    ("uniform-3", "every control face is subdivided three times: 64 triangles each."),
    ("project-sphere", "the paper's first adaptive strategy, as we read it (C25): a face is subdivided until the sphere round it, halved with "
                       "each level, has at most so many pixels on the screen (60 here, where nothing else is said)."),
    ("combined", "the paper's second, as we read it (C82): the larger of project-sphere's depth and of the depth at which the normals at the corners lie within "
                 "an angle (30 degrees here)."),
    ("fans", "the paper's repair of cracks: a face with finer neighbours becomes a fan round its middle and loses its inner points. "
             "Stitched: ours, which keeps them."),
    ("C01, C02, …", "the statements of the paper that can be checked, in our words; those from C83 on were found later."),
    ("T1 to T10", "what a reproduction has to show: sentences about the paper's figures. Their verdicts are those of the claims."),
    ("we conclude", "what is true of the paper's sentence. Our test: whether the test behind that agrees today. A misprint whose test is green "
                    "is a misprint."),
)

NOT_REPRODUCED = (
    ("1, 2, 9", "drawings of masks and of the order of control points: what they define is tested (C10, C12, C65)"),
    ("4, 5", "drawings of the arrays of the sliding window: what they hold is tested (C43 to C47)"),
)


def summary(claims):
    by_id = {c["id"]: c for c in claims["claims"]} if claims else {}
    known = [by_id[i] for i in FINDINGS if i in by_id and by_id[i].get("finding")]
    findings = "".join(f"<li><a href='#{c['id']}'>{c['id']}</a> <i>{text(c['statement'])}</i>: {badge(c['verdict'])}. "
                       f"{text(c['finding'])}" for c in known)
    words = "".join(f"<dt>{text(word)}<dd>{text(meaning)}" for word, meaning in WORDS)
    missing = "; ".join(f"{text(numbers)}: {text(why)}" for numbers, why in NOT_REPRODUCED)
    return ("<p>Müller and Havemann described in 2000 how Loop subdivision surfaces can be tessellated in every frame, with as much depth as "
            "the view needs. Here the claims of their paper are registered one by one, and those that have a test are "
            "checked by running it: formulas in exact arithmetic, pictures pixel by pixel against deep uniform "
            "subdivision.</p>"
            + (f"<p><b>{headline(claims)}</b></p>" if claims else "")
            + (f"<p>What a reader of the paper would not expect:</p><ol>{findings}</ol>" if findings else "")
            + f"<details><summary>What the words mean</summary><dl>{words}</dl></details>"
            + f"<p>Figures that are not reproduced: {missing}. Figures 3, 6 to 8 and 10 to 14 are, from our own data.</p>")
