"""A lecture whose texts try to be more than texts, in every place that a page shows."""

from lucida.app.lecture.reading import lecture_from_toml

CALL = "window.hurt = true"
TEXTS = (
    f"<script>{CALL}</script>",
    f"</script><script>{CALL}</script>",
    f"<img src=x onerror='{CALL}'>",
    f'"><img src=x onerror="{CALL}">',
    f"'><svg/onload={CALL}>",
    f"<svg><script>{CALL}</script></svg>",
    f"</title><script>{CALL}</script>",
    f"</style><script>{CALL}</script>",
    f"</textarea><script>{CALL}</script>",
    f"</template><script>{CALL}</script>",
    f"<!--<script>{CALL}</script>-->",
    f"--><script>{CALL}</script>",
    f"]]><script>{CALL}</script>",
    f"<a href='javascript:{CALL}'>x</a>",
    f"<iframe srcdoc='<script>{CALL}</script>'></iframe>",
    "<iframe src='https://example.com'></iframe>",
    "<link rel=stylesheet href=https://example.com/x.css>",
    "<style>@import url(https://example.com/x.css);</style>",
    "<base href='https://example.com/'>",
    "<meta http-equiv=refresh content='0;url=https://example.com'>",
    "<form action='https://example.com'><button>x</button></form>",
    f"<details open ontoggle='{CALL}'>",
    f"<body onload='{CALL}'>",
    f"<math><mtext><img src=x onerror='{CALL}'></mtext></math>",
    f"<math href='javascript:{CALL}'>x</math>",
    f"<input autofocus onfocus='{CALL}'>",
    f"<video><source onerror='{CALL}'></video>",
    f"<object data='data:text/html,<script>{CALL}</script>'>",
    f"&lt;script&gt;{CALL}&lt;/script&gt;",
    f"&#60;script&#62;{CALL}&#60;/script&#62;",
    f"\\u003cscript\\u003e{CALL}\\u003c/script\\u003e",
    f"'; {CALL}; '",
    f'"; {CALL}; "',
    "${window.hurt = true}",
    "{{constructor.constructor('window.hurt = true')()}}",
    "\u202e<script>\u2028window.hurt = true\u2029</script>",
)
FORMULAS = (
    rf"\href{{javascript:{CALL}}}{{x}}",
    r"\href{https://example.com}{x}",
    rf"\text{{<script>{CALL}</script>}}",
    rf"\text{{<img src=x onerror='{CALL}'>}}",
    rf"\mathrm{{<svg onload={CALL}>}}",
    r"\style{background: url(https://example.com)}{x}",
    rf"\style{{x}}{{\text{{</style><script>{CALL}</script>}}}}",
    r"\class{step current}{x}",
    r"\id{lucida-data}{x}",
    r"\color{red;background:url(https://example.com)}x",
    rf"\textcolor{{'><script>{CALL}</script>}}{{x}}",
    rf"\bbox[border:1px solid red]{{<script>{CALL}</script>}}",
    rf"\unknown{{<script>{CALL}</script>}}",
    rf"\hspace{{1em' onclick='{CALL}}}",
    r"\includegraphics{https://example.com/x.png}",
    rf"\operatorname{{</math><script>{CALL}</script>}}",
    rf"&lt;script&gt;{CALL}",
    rf"\begin{{array}}{{'><script>{CALL}</script>}} x \end{{array}}",
    r"\left( x",
    r"\frac{1}",
    r"x_{",
    r"\\",
    r"^2",
    r"{{{{{{{x}}}}}}}",
)


def hostile_lecture(folder):
    """Return a lecture of one step for each text and each formula."""
    steps = [_step(text, text.replace("`", "").replace("$", r"\$")) for text in TEXTS]
    steps += [_step("A formula", f"${latex}$") for latex in FORMULAS if _is_balanced(latex)]
    lines = [f"title = {_quoted(TEXTS[6])}", f"author = {_quoted(TEXTS[2])}", *steps]
    return lecture_from_toml("\n".join(lines), folder, "hostile.toml")


def _is_balanced(latex):
    return latex.count("{") == latex.count("}")


def _step(name, text):
    shown = _quoted(text)
    title = _quoted(name.replace("\n", " "))
    return f"""
[[steps]]
part = {title}
title = {title}
text = {_quoted(f"{text} **{text}** `{text}`" if "$" not in text else text)}
scene = "canonical"
exercise.kind = "vector"
exercise.question = {shown}
exercise.answers = [
    {{ name = {title}, value = [1, 0, 0], wrong = [{{ value = [0, 1, 0], feedback = {shown} }}] }},
]
"""


def _quoted(text):
    """Return a text as TOML's basic string."""
    escaped = text.replace("\\", "\\\\").replace('"', '\\"')
    return '"' + "".join(c if c.isprintable() else f"\\u{ord(c):04x}" for c in escaped) + '"'
