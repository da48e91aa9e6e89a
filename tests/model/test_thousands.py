import pytest

from mgehl.model.text_table import FileError, read_table


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("0;950\n1;1,050\n2;990\n", "line 2: '1,050' may be 1.050 or 1050"),
        ("0\t950\n1\t1.050\n", "line 2: '1.050' may be 1.050 or 1050"),
        ("0;950\n0.01;1,050\n", "line 2 has '1,050', line 2 '0.01': which is the decimal mark?"),
        ("0,01;950\n0,02;1.050\n", "line 1 has '0,01', line 2 '1.050': which is the decimal mark?"),
        ('0,"1,000"\n1,"1,050"\n', "line 1: '1,000' may be 1.000 or 1000"),
        ("0\t2\u00a0474,9\n1\t2\u00a0475,1\n", "line 1, column 2: '2\\xa0474,9' is no number"),
        ("F [N];v\n500;1\n1.000;1\n2.000;1\n", "line 3: '1.000' may be 1.000 or 1000: write 1000"),
        (";;1,050\n;1;950\n", "line 1: '1,050' may be"),
        (";".join(["975", "1,030"] * 6) + "\n" + ";".join(["1,012"] * 12), "line 1: '1,030' may be"),
    ],
)
def test_a_mark_that_may_be_one_of_thousands_is_refused(tmp_path, text, said):
    """Heights of 1,030 nm beside 975 nm were 1.03 nm, a load of 1,050 N was one of 1.05 N."""
    path = tmp_path / "table.csv"
    path.write_text(text)
    with pytest.raises(FileError) as error:
        read_table(path)
    assert said in str(error.value)


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("0;100,5\n1;1,050\n", 1.05),
        ("0;1,000\n1;1,050\n", 1.05),
        ("0 999.000\n1 1.050\n", 1.05),
        ("0 100\n1 0.125\n", 0.125),
        ("0 1000\n1 1.125\n", 1.125),
        ("0 99\n1 1.125\n", 1.125),
        ('0,"100,5"\n1,"1,050"\n', 1.05),
        ("1,5;100\n2;1,050\n", 1.05),
        ("0 33.333\n1 66.667\n2 100\n", 100.0),
        ("\n".join(8 * [9 * "104.125 ", 9 * "104 "]), 104.0),
        ("\n".join(f"{100 * k}" + 9 * f" 2{k}.12{k}" for k in range(9)), 28.128),
        ("Image size\t512 512\nx\ty\n0.1\t0.2\n", 0.2),
        ("Order;123 456\nx;y\n0.1;0.2\n", 0.2),
    ],
)
def test_others_are_read(tmp_path, text, value):
    path = tmp_path / "table.csv"
    path.write_text(text)
    assert read_table(path).values[-1, -1] == value
