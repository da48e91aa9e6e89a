from mgehl.output.report.page import BAD, picture, render, table


def page_of(**parts):
    page = {"title": "A title", "subtitle": "a subtitle", "verdict": None, "what": []}
    return page | {"tables": [], "pictures": [], "origin": None} | parts


def test_every_text_is_escaped():
    hostile = "<script>alert('1')</script> & \""
    for parts in (
        {"what": [hostile]},
        {"tables": [table(hostile, ("a",), [("b",)])]},
        {"tables": [table("c", (hostile,), [(hostile,)], folded=True)]},
        {"pictures": [picture(hostile, b"", "image/png", (4.0, 4.0))]},
        {"verdict": (BAD, hostile, hostile)},
        {"title": hostile, "subtitle": hostile},
    ):
        html = render(page_of(**parts))
        assert "<script" not in html and "alert(&#39;1&#39;)" in html
