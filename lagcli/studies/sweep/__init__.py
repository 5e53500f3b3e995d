"""Ensembles of motions over parameters and initial states, each row with its certificate."""

from __future__ import annotations

from lagcli.studies.sweep.plan import Plan, WrongPlan, at_times, plan_of, times_of
from lagcli.studies.sweep.run import sweep
from lagcli.studies.sweep.table import WRITERS, Table

__all__ = ["WRITERS", "Plan", "Table", "WrongPlan", "at_times", "plan_of", "sweep", "times_of"]
