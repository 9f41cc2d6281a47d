#include "scenes/studies/elevation_chart.h"

#include <fmt/format.h>

#include <cmath>

#include "perception/vision_list.h"
#include "perception/vision_model.h"

namespace aleph {

std::string elevation_chart_program() {
    constexpr double slowest = 0.1, fastest = 100.0;  // deg/s
    constexpr int steps = 200;
    std::string text =
        "set terminal pngcairo size 1000,380 font \"DejaVu Sans,10\"\nset output \"plot.png\"\nset encoding utf8\n"
        "set logscale xy\nset grid\nset xrange [0.1:100]\nset yrange [1:300]\nset xlabel \"image velocity, deg/s\"\n"
        "set ylabel \"elevation f\"\nset key top left\nset multiplot layout 1,3\n";
    for (const double rho : {16.0, 4.0, 1.0}) {
        const std::string name = fmt::format("$at{:g}", rho);
        text += name + " << END\n";
        for (int i = 0; i <= steps; ++i) {
            const double v = slowest * std::pow(fastest / slowest, static_cast<double>(i) / steps);
            text += fmt::format("{}", v);
            const Stimulus seen{.frequency = rho,
                                .retinal = retinal_velocity(v, tracking_efficiency),
                                .tracked = tracked_velocity(v, tracking_efficiency)};
            for (const VisionModel* const vision : {&thesis_vision(), &laird_vision(), &castle_vision()}) {
                text += fmt::format(" {}", vision->elevation(seen, {}));
            }
            text += "\n";
        }
        text += "END\n";
        text += fmt::format("set title \"{:g} cycles per degree\"\n", rho);
        text += fmt::format(
            "plot {0} using 1:2 with lines lw 2 title \"thesis\", {0} using 1:3 with lines lw 2 title \"laird\", {0} "
            "using 1:4 with lines lw 2 title \"castle\"\n",
            name);
    }
    return text + "unset multiplot\n";
}

}  // namespace aleph
