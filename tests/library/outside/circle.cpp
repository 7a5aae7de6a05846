// Goals in (t,x,y,z), what is felt of a flat depth image out, as `dibhr touch` writes it.
#include <cstdio>
#include <vector>

#include <dibhr/touch.hpp>

int main() {
    const dibhr::DepthImage image{720, 486, 255.0, std::vector<float>(720 * 486, 128.0F)};
    dibhr::TouchParameters parameters;
    parameters.friction = {0.4, 0.4};
    const dibhr::DepthSurface surface(image, image, 0.0, parameters.shape);
    dibhr::TouchRenderer renderer;
    dibhr::SafetyInput input;
    dibhr::Vec3 goal;
    double last_t = -0.001;
    for (double t; std::scanf("%lf,%lf,%lf,%lf", &t, &goal.x, &goal.y, &goal.z) == 4; last_t = t) {
        input.dt_s = t - last_t;
        const dibhr::Touch& touch = renderer.update(surface, goal, parameters, input, {});
        std::printf("%.17g,", t);
        for (const dibhr::Vec3& v :
             {goal, touch.proxy.position, touch.spring_force_newton, touch.sent_force_newton}) {
            std::printf("%.17g,%.17g,%.17g,", v.x, v.y, v.z);
        }
        const dibhr::Primitive& active = touch.proxy.active;
        std::printf("%d,%s,%d,%d,%d\n", touch.proxy.contact, name_of(active.kind), active.i,
                    active.j, touch.proxy.moves);
    }
}
