#include "render/python/bindings.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "engine/base/errors.h"
#include "render/python/arrays.h"
#include "render/settings/setting_table.h"

namespace aleph::python {

namespace {

using Floats = py::array_t<float, py::array::c_style | py::array::forcecast>;

/// A function's result, with one value for each pixel; a single value stands for all.
/// @throws InputError
Floats to_row(const py::object& result, py::ssize_t count, const char* what) {
    const Floats values = Floats::ensure(result);
    if (!values || (values.ndim() != 0 && values.size() != count)) {
        PyErr_Clear();
        throw InputError("", what, fmt::format("expected {} numbers, one for each that it was given", count));
    }
    if (values.ndim() != 0) return values;
    return Floats(py::module_::import("numpy").attr("full")(count, values, "float32"));
}

class PythonVision : public VisionModel {
  public:
    PythonVision(std::string name, py::function elevation, py::object threshold)
        : name_(std::move(name)), elevation_(std::move(elevation)), threshold_(std::move(threshold)) {}

    std::string name() const override { return name_; }
    std::string summary() const override { return "a Python function"; }
    bool uses_luminance() const override { return true; }

    ElevationRowMaker make_rows(const std::array<double, band_count>& rho, const Presentation&) const override {
        return [this, rho](int width) { return std::make_unique<Row>(*this, rho, width); };
    }

    void thresholds(const float* luminance, std::size_t count, float* out) const override {
        const py::gil_scoped_acquire lock;
        if (threshold_.is_none()) return thesis_vision().thresholds(luminance, count, out);
        const Floats values = to_row(threshold_(row(luminance, count)), static_cast<py::ssize_t>(count), "threshold");
        for (std::size_t i = 0; i < count; ++i) {
            out[i] = values.data()[i];
            if (!(out[i] > 0.0f) || !std::isfinite(out[i]))
                throw InputError("", "threshold",
                                 fmt::format("{} cd/m2 for {} cd/m2: it has to be above 0", out[i], luminance[i]));
        }
    }

    void find_elevations(double frequency, const StimulusRow& of, std::size_t count, float* out) const {
        const py::gil_scoped_acquire lock;
        const Floats values =
            to_row(elevation_(frequency, row(of.retinal, count), row(of.tracked, count), row(of.luminance, count)),
                   static_cast<py::ssize_t>(count), "elevation");
        for (std::size_t i = 0; i < count; ++i) {
            if (std::isnan(values.data()[i])) throw InputError("", "elevation", "it gave NaN");
            out[i] = std::clamp(values.data()[i], 1.0f, static_cast<float>(highest_aleph));
        }
    }

  private:
    class Row : public ElevationRow {
      public:
        Row(const PythonVision& vision, const std::array<double, band_count>& rho, int width)
            : vision_(vision), rho_(rho), width_(static_cast<std::size_t>(width)) {}
        void load(const StimulusRow& row) override { row_ = row; }
        void elevations(int band, float* out) const override {
            vision_.find_elevations(rho_.at(static_cast<std::size_t>(band)), row_, width_, out);
        }

      private:
        const PythonVision& vision_;
        std::array<double, band_count> rho_;
        std::size_t width_;
        StimulusRow row_;
    };

    static py::array_t<float> row(const float* values, std::size_t count) {
        return py::array_t<float>(static_cast<py::ssize_t>(count), values);
    }

    std::string name_;
    py::function elevation_;
    py::object threshold_;
};

class PythonAdapter : public AccuracyAdapter {
  public:
    explicit PythonAdapter(py::function adapter) : adapter_(std::move(adapter)) {}

    Image<float> adapt(const Image<float>& aleph, double accuracy) const override {
        const py::gil_scoped_acquire lock;
        const py::array_t<float> given({py::ssize_t{aleph.height}, py::ssize_t{aleph.width}}, aleph.pixels.data());
        return take_numbers(adapter_(given, accuracy), "adapter");
    }

  private:
    py::function adapter_;
};

class PythonRule : public StoppingRule {
  public:
    explicit PythonRule(py::function rule) : rule_(std::move(rule)) {}

    std::vector<std::uint8_t> find_enough(const StagePixels& pixels) const override {
        const py::gil_scoped_acquire lock;
        const py::object result =
            rule_(copy_list(pixels.x), copy_list(pixels.y), copy_list(pixels.samples), copy_list(pixels.error),
                  copy_list(pixels.deviation), copy_list(pixels.tolerance));
        const Floats values = to_row(result, static_cast<py::ssize_t>(pixels.x.size()), "stopping rule");
        std::vector<std::uint8_t> enough;
        for (py::ssize_t i = 0; i < values.size(); ++i) enough.push_back(values.data()[i] != 0.0f);
        return enough;
    }

  private:
    py::function rule_;
};

/// A setting's value: a bool, a number, text, or a sequence (a size, or a list of names).
/// @throws InputError naming the key
SettingValue to_setting(const std::string& key, const py::handle& value) {
    if (py::isinstance<py::bool_>(value) || py::isinstance(value, py::module_::import("numpy").attr("bool_")))
        return py::bool_(py::reinterpret_borrow<py::object>(value)).cast<bool>();
    if (py::isinstance<py::str>(value)) return value.cast<std::string>();
    if (py::isinstance<py::sequence>(value)) {
        std::vector<std::string> parts;
        for (const py::handle part : value) parts.push_back(py::str(part));
        return fmt::format("{}", fmt::join(parts, key == "size" ? "x" : ","));
    }
    if (PyNumber_Check(value.ptr()) != 0) {
        try {
            return py::float_(py::reinterpret_borrow<py::object>(value)).cast<double>();
        } catch (const py::error_already_set&) {
        }
    }
    throw InputError("", key, "expected a number, text, True or False");
}

}  // namespace

std::unique_ptr<VisionModel> make_vision(const std::string& name, const py::function& elevation,
                                         const py::object& threshold) {
    return std::make_unique<PythonVision>(name, elevation, threshold);
}

GivenSettings read_settings(Scene& scene, const py::dict& arguments, bool of_scene) {
    GivenSettings given;
    SettingMap map;
    for (const auto& [name, value] : arguments) {
        const auto key = name.cast<std::string>();
        const auto function =
            py::isinstance<py::function>(value) ? py::reinterpret_borrow<py::function>(value) : py::function();
        if (!function) {
            if (!value.is_none()) map[key] = to_setting(key, value);
        } else if (key == "vision") {
            given.vision = make_vision("own", function, py::none());
        } else if (key == "adapter") {
            given.adapter = std::make_unique<PythonAdapter>(function);
        } else if (key == "sampling") {
            given.rule = std::make_unique<PythonRule>(function);
            map[key] = std::string("variance");
        } else {
            throw InputError("", key, "a function can be the vision, the adapter or the sampling");
        }
    }
    if (of_scene)
        add_default_error(scene.source.settings, map);
    else
        refuse_settings_of_scenes(map);
    apply_settings(given.settings, scene.source.settings, scene.source.file);
    set_scene_numbers(scene, map, "");
    apply_settings(given.settings, map, "");
    if (given.vision) given.settings.perception.vision = given.vision.get();
    given.settings.guide.own_adapter = given.adapter.get();
    given.settings.sampling.own_rule = given.rule.get();
    return given;
}

}  // namespace aleph::python
