// Boost.odeint: dopri5 with dense output; events are found in each step,
// both the ends and the turning point within it. Two ways: the record as one
// function, as most would write it; and a stop at every sample, where the
// forcing has its kinks.
#include <array>
#include <boost/numeric/odeint.hpp>
#include <boost/version.hpp>

#include "scene.hpp"

namespace odeint = boost::numeric::odeint;
using State = std::array<double, 2>;
using Dopri5 = odeint::runge_kutta_dopri5<State>;

// Root of `value` between a and b, where it has different signs.
template <class F>
double root(F value, double a, double b) {
    double va = value(a), vb = value(b);
    if (va == 0) return a;
    for (int i = 0; i < 200; i++) {
        // Secant, kept away from the ends; bisection every third turn.
        double m = i % 3 == 2 ? 0.5 * (a + b) : a - va * (b - a) / (vb - va);
        if (!(m > a && m < b)) m = 0.5 * (a + b);
        if (m == a || m == b) break;
        double vm = value(m);
        if (vm == 0) return m;
        if ((va < 0) == (vm < 0)) a = m, va = vm;
        else b = m, vb = vm;
        if (b - a < 4e-16 * std::abs(b)) break;
    }
    return b;
}

// `plain`: as the documentation's examples do, without a step chosen.
Flight flights(const Scene& scene, long& work, double rtol, bool stops,
               bool plain = false) {
    return [&scene, &work, rtol, stops, plain](double t, double side,
                                               double w) {
        const double last = scene.end + scene.beyond;
        double f0 = 0, slope = 0, origin = 0;
        auto fixed = [&](const State& x, State& d, double time) {
            work++;
            double f = f0 + slope * (time - origin);
            d = {x[1], scene.acceleration(x[0], side, f)};
        };
        auto whole = [&](const State& x, State& d, double time) {
            work++;
            d = {x[1], scene.acceleration(x[0], side, scene.force(time))};
        };
        State x{scene.u, w};
        double peak = 0, peak_t = t;
        double step = plain ? 0.01 : scene.first_step(w);
        while (t < last) {
            // The next instant to stop at.
            double stop = last;
            if (t < scene.end) stop = scene.end;
            if (stops) {
                // The quotient may come out just below a whole number.
                size_t k = size_t(t / scene.dt);
                if (t >= scene.end) k = scene.slope.size();
                else if (double(k + 1) * scene.dt - t < 1e-12) k++;
                if (k < scene.slope.size()) {
                    stop = double(k + 1) * scene.dt;
                    f0 = scene.f[k], slope = scene.slope[k];
                    origin = double(k) * scene.dt;
                } else {
                    f0 = slope = 0;
                }
            }
            auto stepper = odeint::make_dense_output(
                plain ? rtol : rtol * scene.alpha, rtol,
                !plain && stop <= scene.end ? scene.dt : 1e9, Dopri5());
            stepper.initialize(x, t, std::min(step, stop - t));
            bool beyond = false;
            while (!beyond) {
                auto [a, b] = stops ? stepper.do_step(fixed)
                                    : stepper.do_step(whole);
                step = stepper.current_time_step();
                if (b >= stop) b = stop, beyond = true;
                auto at = [&](double time) {
                    State s;
                    stepper.calc_state(time, s);
                    return s;
                };
                State begin = stepper.previous_state(), end = at(b);
                // The step in two where the velocity changes its sign.
                double cuts[3] = {a, b, b};
                int parts = 1;
                if ((begin[1] > 0) != (end[1] > 0) && begin[1] != 0) {
                    cuts[1] = root([&](double s) { return at(s)[1]; }, a, b);
                    parts = 2;
                }
                for (int i = 0; i < parts; i++) {
                    State s = at(cuts[i + 1]);
                    if (s[0] < 0) {
                        double from = cuts[i];
                        // From the base itself: past the root at the start.
                        if (i == 0 && begin[0] == 0) from += 1e-3 * (cuts[1] - a);
                        double hit = root([&](double z) { return at(z)[0]; },
                                          from, cuts[i + 1]);
                        return Landing{Kind::Impact, hit, at(hit)[1],
                                       peak, 0, peak_t};
                    }
                    if (s[0] >= scene.limit) {
                        double hit = root(
                            [&](double z) { return at(z)[0] - scene.limit; },
                            cuts[i], cuts[i + 1]);
                        return Landing{Kind::Overturned, hit, at(hit)[1],
                                       peak, scene.limit, peak_t};
                    }
                    if (s[0] > peak) peak = s[0], peak_t = cuts[i + 1];
                }
                x = end, t = b;
            }
        }
        Kind kind = scene.beyond > 0 ? Kind::Failed : Kind::Stop;
        return Landing{kind, t, x[1], peak, x[0], peak_t};
    };
}

// `odeint singles FOLDER`, `odeint chains FOLDER WORK RTOL...`, or
// `odeint serve default|best`.
int main(int argc, char** argv) {
    if (std::string(argv[1]) == "serve") {
        const bool plain = std::string(argv[2]) == "default";
        serve([&](const Scene& scene, double t, double side, double w) {
            long work = 0;
            double rtol = plain ? 1e-6 : 1e-13;
            return flights(scene, work, rtol, false, plain)(t, side, w);
        });
        return 0;
    }
    const bool singles = std::string(argv[1]) == "singles";
    const std::string version = std::to_string(BOOST_VERSION / 100000) + "." +
                                std::to_string(BOOST_VERSION / 100 % 1000);
    std::vector<std::string> tolerances{"1e-06", "1e-09", "1e-12"};
    if (singles) header();
    else tolerances.assign(argv + 4, argv + argc);
    for (bool stops : {false, true})
        for (const std::string& rtol : tolerances) {
            const double relative = std::stod(rtol);
            auto own = [&](const Scene& scene, long& work) {
                return flights(scene, work, relative, stops);
            };
            const std::string method =
                stops ? "dopri5 sample by sample" : "dopri5";
            if (singles)
                measure("Boost.odeint," + version + "," + method + ",rtol " +
                            rtol,
                        argv[2], own);
            else
                measure_chains("\"" + std::string(argv[3]) +
                                   ", Boost.odeint " + method + ", rtol " +
                                   rtol + "\"",
                               argv[2], own);
        }
}
