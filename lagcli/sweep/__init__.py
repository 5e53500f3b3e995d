"""Ensembles of motions over parameters and initial states, each row with its certificate."""

from __future__ import annotations

from lagcli.sweep.plan import Plan, WrongPlan, plan_of
from lagcli.sweep.run import sweep
from lagcli.sweep.table import WRITERS, Table

__all__ = ["WRITERS", "Plan", "Table", "WrongPlan", "plan_of", "sweep"]
