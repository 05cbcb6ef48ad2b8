"""CBC and GLPK, called as the libraries that their programs consist of, so that only solving is timed.

Settings as `nda compare` has them: gaps 0, and for CBC no `increment`, which would throw away solutions that are better
by less than 1e-5.
"""

import ctypes
import re

import numpy as np

from rivals.solvers import Spent, rounded, timed


def cbc_incumbents(lines):
    """(second, value) from the log of CBC, times to a hundredth of a second."""
    found = []
    for line in lines:
        match = re.search(r"olution of (-?[\d.e+]+) found .*\(([\d.]+) seconds\)", line)
        match = match or re.search(r"improved solution from \S+ to (-?[\d.e+]+) \(([\d.]+) seconds\)", line)
        match = match or re.search(r"on tree, (-?[\d.e+]+) best solution, .*\(([\d.]+) seconds\)", line)
        if match and abs(float(match[1])) < 1e49 and (not found or float(match[1]) < found[-1][1]):
            found.append((float(match[2]), float(match[1])))
    return found


def _doubles(values):
    return np.ascontiguousarray(values, dtype=float).ctypes.data_as(ctypes.POINTER(ctypes.c_double))


def _integers(values):
    return np.ascontiguousarray(values, dtype=np.int32).ctypes.data_as(ctypes.POINTER(ctypes.c_int))


def _library(name):
    try:
        return ctypes.CDLL(name)
    except OSError:
        return None


class Cbc:
    """COIN's branch and cut, by the C interface of the library that its program consists of."""

    name = "cbc"
    settings = {"ratioGap": "0", "allowableGap": "0", "increment": "1e-9", "timeMode": "elapsed", "threads": "0"}

    def __init__(self, log):
        self._log = log
        self._cbc = _library("libCbcSolver.so.3")
        self._cbc.Cbc_newModel.restype = ctypes.c_void_p
        self._cbc.Cbc_bestSolution.restype = ctypes.POINTER(ctypes.c_double)
        self._cbc.Cbc_getBestPossibleObjValue.restype = ctypes.c_double

    @staticmethod
    def find():
        library = _library("libCbcSolver.so.3")
        if not library:
            return None
        library.Cbc_getVersion.restype = ctypes.c_char_p
        return "CBC " + library.Cbc_getVersion().decode()

    def mip(self, model, limit_s):
        cbc, handle = self._cbc, ctypes.c_void_p(self._cbc.Cbc_newModel())
        num_rows, num_columns = model.matrix.shape
        lower = np.where(model.lower > 0, 1.0, -np.inf)
        cbc.Cbc_loadProblem(
            handle, num_columns, num_rows, _integers(model.matrix.indptr), _integers(model.matrix.indices),
            _doubles(model.matrix.data), _doubles(np.zeros(num_columns)), _doubles(np.ones(num_columns)),
            _doubles(model.costs), _doubles(lower), _doubles(np.ones(num_rows)),
        )  # fmt: skip
        for column in range(num_columns):
            cbc.Cbc_setInteger(handle, column)
        for name, value in {**self.settings, "seconds": str(max(0.01, limit_s))}.items():
            cbc.Cbc_setParameter(handle, name.encode(), value.encode())
        spent = Spent()
        timed(spent, cbc.Cbc_solve, handle)
        answer = self._answer(model, handle, spent, limit_s)
        cbc.Cbc_deleteModel(handle)
        return answer

    def _answer(self, model, handle, spent, limit_s):
        cbc, lines = self._cbc, self._log.take()
        status = "limit"
        if cbc.Cbc_isProvenInfeasible(handle):
            status = "infeasible"
        elif cbc.Cbc_isProvenOptimal(handle):
            status = "optimal"
        best = cbc.Cbc_bestSolution(handle)
        x = np.ctypeslib.as_array(best, (len(model.costs),)).copy() if best else None
        if status == "optimal" and x is None or status == "limit" and spent.wall < 0.8 * limit_s:
            status = "failed"
        bound = float(cbc.Cbc_getBestPossibleObjValue(handle))
        return rounded(model, status, spent, x, bound if abs(bound) < 1e49 else -np.inf, cbc_incumbents(lines))


class _GlpkParameters(ctypes.Structure):
    """glp_iocp of glpk.h, version 5."""

    _fields_ = [
        *((name, ctypes.c_int) for name in ("msg_lev", "br_tech", "bt_tech")),
        *((name, ctypes.c_double) for name in ("tol_int", "tol_obj")),
        *((name, ctypes.c_int) for name in ("tm_lim", "out_frq", "out_dly")),
        *((name, ctypes.c_void_p) for name in ("cb_func", "cb_info")),
        *((name, ctypes.c_int) for name in ("cb_size", "pp_tech")),
        ("mip_gap", ctypes.c_double),
        *((name, ctypes.c_int) for name in ("mir_cuts", "gmi_cuts", "cov_cuts", "clq_cuts", "presolve", "binarize")),
        *((name, ctypes.c_int) for name in ("fp_heur", "ps_heur", "ps_tm_lim", "sr_heur", "use_sol")),
        ("save_sol", ctypes.c_void_p),
        *((name, ctypes.c_int) for name in ("alien", "flip")),
        ("rest", ctypes.c_double * 32),
    ]


class Glpk:
    """GNU's kit, called as its program glpsol calls it: presolve, then branch and bound without cuts."""

    name = "glpk"
    _ON, _UPPER, _FIXED, _BOTH, _BINARY = 1, 3, 5, 4, 3
    _OPTIMAL, _FEASIBLE, _NONE = 5, 2, 4
    _TIME_LIMIT, _NO_PRIMAL = 0x09, 0x0A

    def __init__(self, log):
        self._log = log
        self._glpk = _library("libglpk.so.40")
        self._glpk.glp_create_prob.restype = ctypes.c_void_p
        self._glpk.glp_mip_col_val.restype = ctypes.c_double

    @staticmethod
    def find():
        library = _library("libglpk.so.40")
        if not library:
            return None
        library.glp_version.restype = ctypes.c_char_p
        return "GLPK " + library.glp_version().decode()

    def _load(self, model):
        glpk, handle = self._glpk, ctypes.c_void_p(self._glpk.glp_create_prob())
        num_rows, num_columns = model.matrix.shape
        glpk.glp_add_rows(handle, num_rows)
        glpk.glp_add_cols(handle, num_columns)
        one, zero = ctypes.c_double(1), ctypes.c_double(0)
        for row in range(num_rows):
            glpk.glp_set_row_bnds(handle, row + 1, self._FIXED if model.lower[row] > 0 else self._UPPER, one, one)
        for column in range(num_columns):
            glpk.glp_set_col_kind(handle, column + 1, self._BINARY)
            glpk.glp_set_obj_coef(handle, column + 1, ctypes.c_double(model.costs[column]))
        entries = model.matrix.tocoo()
        rows, columns = np.concatenate([[0], entries.row + 1]), np.concatenate([[0], entries.col + 1])
        values = np.concatenate([[0.0], entries.data])
        glpk.glp_load_matrix(handle, len(entries.data), _integers(rows), _integers(columns), _doubles(values))
        return handle

    def mip(self, model, limit_s):
        handle, parameters = self._load(model), _GlpkParameters()
        self._glpk.glp_init_iocp(ctypes.byref(parameters))
        parameters.presolve = self._ON
        parameters.tm_lim = max(1, int(1000 * limit_s))
        spent = Spent()
        code = timed(spent, self._glpk.glp_intopt, handle, ctypes.byref(parameters))
        self._log.take()
        found = self._glpk.glp_mip_status(handle)
        status = "failed"
        if code == self._NO_PRIMAL or found == self._NONE:
            status = "infeasible"
        elif code == self._TIME_LIMIT:
            status = "limit"
        elif code == 0 and found == self._OPTIMAL:
            status = "optimal"
        x = None
        if found in (self._OPTIMAL, self._FEASIBLE):
            x = np.array([self._glpk.glp_mip_col_val(handle, column + 1) for column in range(len(model.costs))])
        self._glpk.glp_delete_prob(handle)
        return rounded(model, status, spent, x, -np.inf, [])
