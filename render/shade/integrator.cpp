#include "render/shade/integrator.h"

#include "engine/base/errors.h"

namespace aleph {

void LightIntegrator::fill(const SampleHits&) {}

void LightIntegrator::fill_waiting(const std::vector<PendingSample>& waiting) {
    ALEPH_CHECK(waiting.empty(), "samples wait for light that nothing computes");
}

void LightIntegrator::add_waiting(ShadingTask&, PendingSample&) {}

std::unique_ptr<LightIntegrator> make_integrator(const IntegratorInput& input) {
    switch (input.context.settings.light.integrator) {
        case Integrator::path:
            return make_path_integrator(input);
        case Integrator::cache:
            break;
    }
    return make_cache_integrator(input);
}

}  // namespace aleph
