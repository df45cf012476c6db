// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pybind11/pybind11.h>

#include "map_export/map_diff.h"
#include "sslcd/change/map_history.h"
#include "sslcd/closing/localisation.h"
#include "sslcd/store/map_store.h"
#include "sslcd/store/merge_maps.h"

namespace sslcd::python {

namespace py = pybind11;

/// The dataclass of the same name in sslcd.map_results, which documents the fields.
py::object ToPython(const SessionInfo& session);
py::object ToPython(const MapInfo& info);
py::object ToPython(const MapResults& results, const MapInfo& info);
py::object ToPython(const Localisation& found);
py::object ToPython(const PlaceHistory& place);
py::object ToPython(const ChangeRates& rates);
py::object ToPython(const PlaceOutcome& outcome);
py::object ToPython(const MapDiff& diff, const MapInfo& info);
py::object ToPython(const MergeReport& report);

/// Symmetry by label.
py::dict ToPython(const LabelTable& labels);

}  // namespace sslcd::python
