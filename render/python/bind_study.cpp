// Studies: what settings cost and what error they leave.

#include <pybind11/stl.h>

#include <nlohmann/json.hpp>

#include "engine/base/errors.h"
#include "engine/base/parallel.h"
#include "render/python/bindings.h"
#include "render/study/prepared_study.h"
#include "render/study/run_study.h"
#include "render/study/search_study.h"
#include "render/study/study.h"
#include "render/study/study_files.h"

namespace aleph::python {

namespace {

Study take_study(const py::object& source) {
    if (py::isinstance<py::dict>(source)) return parse_study(to_json(source), "");
    const std::filesystem::path path = to_path(source);
    if (is_study(path)) return load_study(path);
    throw InputError(path.string(), "",
                     "a scene needs what is compared, such as sweep={'error': [0.5, 1, 2]}; a study file has it");
}

/// A study's table as text, and what the page needs as JSON.
py::tuple run(const py::object& source, const py::object& folder, int threads, const py::object& on_progress) {
    Study study = take_study(source);
    const std::filesystem::path kept = to_path(folder);
    std::string csv, json;
    run_without_lock(threads, on_progress, [&](const FrameProgress& progress) {
        const PreparedStudy prepared = prepare_study(std::move(study));
        const auto show = [&](double share, const std::string& what) { progress(share, what.c_str()); };
        const StudyResults results =
            prepared.study.search ? search_study(prepared, kept, show) : run_study(prepared, kept, show);
        csv = study_csv(prepared, results);
        json = study_json(prepared, results, {"aleph.study", study_date(), thread_count(), kept}).dump();
    });
    return py::make_tuple(csv, from_json(json));
}

}  // namespace

void bind_study(py::module_& module) {
    module.def(
        "run_study", &run, py::arg("study"), py::arg("folder"), py::kw_only(), py::arg("threads") = 0,
        py::arg("on_progress") = py::none(),
        "Runs a study, a dict or a file; returns its table as comma-separated values and its results as a dict.");
}

}  // namespace aleph::python
