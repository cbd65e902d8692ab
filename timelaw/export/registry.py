"""The registry of formats, by the name that users give them."""

from timelaw.export.aem import AEM_1, AEM_2
from timelaw.export.arrays import MAT, NPZ
from timelaw.export.basilisk import BASILISK
from timelaw.export.c99 import C99
from timelaw.export.exporter import Exporter
from timelaw.export.formula_text import FORMULA
from timelaw.export.gltf import GLTF
from timelaw.export.ros import ROS
from timelaw.export.samples_csv import CSV
from timelaw.export.stk import STK
from timelaw.export.tum import TUM

EXPORTERS: dict[str, Exporter] = {
    "csv": CSV,
    "npz": NPZ,
    "mat": MAT,
    "aem": AEM_2,
    "aem-1.0": AEM_1,
    "stk": STK,
    "basilisk": BASILISK,
    "ros": ROS,
    "tum": TUM,
    "gltf": GLTF,
    "c99": C99,
    "formula": FORMULA,
}
