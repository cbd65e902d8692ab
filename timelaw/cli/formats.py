"""The list of formats in the help of `timelaw export`, which is loaded when it is shown."""

import click


class ListingCommand(click.Command):
    """A command whose help ends with what each format carries and loses."""

    def format_epilog(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:  # noqa: ARG002
        """One entry a format, from the registry."""
        from timelaw.export.registry import EXPORTERS

        with formatter.section("Formats"):
            formatter.write_dl(
                [(name, f"{e.carries}. Lost: {e.loses}.") for name, e in EXPORTERS.items()], col_max=12
            )
