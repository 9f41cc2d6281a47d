#include "render/shade/integrator.h"

namespace aleph {

void LightIntegrator::fill(const SampleHits&) {}

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
