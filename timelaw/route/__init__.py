"""The route: great-circle arcs on S³ from node to node, without any notion of time."""

from timelaw.route.leg import Leg
from timelaw.route.route import Node, Route, Run, lay_route

__all__ = ["Leg", "Node", "Route", "Run", "lay_route"]
