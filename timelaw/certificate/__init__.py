"""The certificate: what is proved of a law, from the emitted law alone."""

from timelaw.certificate.certificate import Certificate, certify
from timelaw.certificate.continuity import Continuity, NodeReport
from timelaw.certificate.limit_check import LimitCheck

__all__ = ["Certificate", "Continuity", "LimitCheck", "NodeReport", "certify"]
