"""Names of choices, made of the rows of the program by its tests."""

from typing import Literal

ExchangeFormat = Literal[
    "nrml",
    "pelicun",
    "pact",
    "csv",
]
