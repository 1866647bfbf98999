"""Tables over time, as OpenSim's .sto and .mot files hold them."""


class Table(dict):
    """Columns by their names, each (rows,) float64; "time" is in s, others in the file's own units.

    name: str, of the table. in_degrees: bool, of columns that are angles. warnings: what was wrong with the file but
    could be survived, a sentence each.
    """

    name = ""
    in_degrees = False
    warnings = ()
