// A case as `rocking speed --export` writes it, and what every driver
// shares: rest, uplift, impacts. See scene.py, which says it in words.
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iostream>
#include <limits>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

// A stretch of the acceleration over g, as `Piece` of benchmark.py has it.
struct Piece {
    double t0, t1;
    std::string kind;
    double a, b, c;

    double force(double t) const {
        if (kind == "line") return a + b * (t - t0);
        if (kind == "sine") return a * std::sin(b * t);
        if (kind == "cosine") return a * std::cos(b * t);
        double square = b * (t - c) * b * (t - c);
        return a * (1 - square) * std::exp(-square / 2);
    }
};

struct Scene {
    std::string name;
    double alpha, p, eta, dt, end, threshold, cosine;
    std::vector<double> f, slope;

    std::vector<double> levels, samples;

    // What only `serve` sets: the rotation at the start and at overturning,
    // how long a flight may go on after `end`, pieces instead of samples.
    double u = 0, limit, beyond = 60;
    bool linear = false;
    std::vector<Piece> pieces;

    Scene() = default;

    explicit Scene(const std::string& path) {
        std::ifstream in(path);
        std::string key, list;
        size_t n = 0;
        in >> key >> name >> key >> alpha >> key >> p >> key >> eta >> key >>
            dt >> key >> list >> key >> n;
        samples.resize(n);
        for (double& x : samples) in >> x;
        if (!in) throw std::runtime_error(path + ": not a case");
        std::stringstream text(list);
        while (std::getline(text, list, ','))
            levels.push_back(std::stod(list));
        end = double(n - 1) * dt;
        limit = alpha;
        threshold = std::tan(alpha);
        cosine = std::cos(alpha);
        scale(levels.front());
    }

    void scale(double level) {
        f.clear(), slope.clear();
        for (double x : samples) f.push_back(level * x);
        for (size_t k = 0; k + 1 < f.size(); k++)
            slope.push_back((f[k + 1] - f[k]) / dt);
    }

    double force(double t) const {
        if (!pieces.empty()) {
            size_t i = 0;
            while (i + 1 < pieces.size() && t >= pieces[i].t1) i++;
            return pieces[i].force(t);
        }
        size_t k = size_t(t / dt);
        return k < slope.size() ? f[k] + slope[k] * (t - double(k) * dt) : 0.0;
    }

    // Of u = |theta| on that side.
    double acceleration(double u, double side, double f) const {
        double y = alpha - u;
        if (linear) return -p * p * (y + side * f);
        return -p * p * (std::sin(y) + side * f * std::cos(y));
    }

    // First instant from t on with |f| above the threshold, and sgn f.
    std::optional<std::pair<double, double>> exceedance(double t) const {
        size_t first = size_t(t / dt);
        for (size_t k = first; k < slope.size(); k++) {
            double start = k == first ? t : double(k) * dt;
            double now = f[k] + slope[k] * (start - double(k) * dt);
            if (std::abs(now) > threshold)
                return {{start, std::copysign(1.0, now)}};
            double last = f[k + 1];
            if (std::abs(last) > threshold) {
                double sign = std::copysign(1.0, last);
                return {{start + (sign * threshold - now) / slope[k], sign}};
            }
        }
        return {};
    }

    double restoring(double force) const { return (threshold + force) * cosine; }

    // Time within which the hops after an impact provably end.
    std::optional<double> chatter(double t, double side, double speed) const {
        size_t k = size_t(t / dt);
        if (k >= slope.size()) return {};
        double now = side * (f[k] + slope[k] * (t - double(k) * dt));
        double w = speed / p, left = (double(k + 1) * dt - t) * p;
        if (!(threshold - std::abs(now) > 0)) return {};
        double guess = 2 * w / (restoring(-std::abs(now)) * (1 - eta));
        if (!(guess < left)) return {};
        double window = std::min(2 * guess, left);
        double drift = std::abs(slope[k] / p) * window;
        double least = restoring(-(std::abs(now) + drift));
        if (!(least > 0)) return {};
        double push = (1 + threshold) * 2 * w * w / least;
        least -= push;
        if (!(least > 0)) return {};
        auto ratio = [&](double x) {
            return (restoring(x + drift) + push) / (restoring(x - drift) - push);
        };
        double worst = std::max(ratio(now), ratio(-now));
        double decay = eta * std::sqrt(worst);
        if (!(decay < 1)) return {};
        double bound = 2 * w * std::sqrt(worst) / (least * (1 - decay));
        if (!(bound < window)) return {};
        double hops = 1 / restoring(now) + eta / restoring(-now);
        return 2 * w * hops / (1 - eta * eta) / p;
    }

    // A step well inside the next hop: a longer one skips an impact.
    double first_step(double w) const {
        if (w == 0) return 0.1 * dt;
        return std::min(0.2 * std::abs(w) / (p * p * alpha), dt);
    }
};

enum class Kind { Impact, Overturned, Stop, Failed };

struct Landing {
    Kind kind;
    double t, w, peak, u = 0, peak_t = 0;
};

struct Result {
    double peak;
    std::vector<double> impacts;
};

using Flight = std::function<Landing(double t, double side, double w)>;

// Fifty times those of any analysis: a tool that bounces on the spot fails.
constexpr size_t MOST_IMPACTS = 100000;

inline Result run(const Scene& scene, const Flight& flight) {
    const double inf = std::numeric_limits<double>::infinity();
    double peak = 0, t = 0;
    std::vector<double> impacts;
    while (auto lifted = scene.exceedance(t)) {
        t = lifted->first;
        double side = -lifted->second, w = 0;
        while (true) {
            Landing end = flight(t, side, w);
            peak = std::max(peak, end.peak);
            t = end.t;
            if (end.kind == Kind::Overturned) return {inf, impacts};
            if (end.kind == Kind::Failed)
                throw std::runtime_error(scene.name + ": a flight failed");
            if (t > scene.end) return {peak / scene.alpha, impacts};
            impacts.push_back(t);
            if (impacts.size() > MOST_IMPACTS)
                throw std::runtime_error(scene.name + ": impacts without end");
            side = -side;
            w = -scene.eta * end.w;
            if (auto rest = scene.chatter(t, side, w)) {
                t += *rest;
                break;
            }
        }
    }
    return {peak / scene.alpha, impacts};
}

// Flies on request, for benchmark.py: `alpha p linear limit side t u w stop n`
// and n pieces a line; answers `kind t u w peak peak_t`.
template <class Fly>
void serve(Fly fly) {
    const char* names[] = {"impact", "overturned", "stop", "failed"};
    Scene scene;
    double side, t, w;
    size_t n;
    while (std::cin >> scene.alpha >> scene.p >> scene.linear >> scene.limit >>
           side >> t >> scene.u >> w >> scene.end >> n) {
        scene.beyond = 0, scene.dt = 0.01;
        scene.pieces.resize(n);
        for (Piece& x : scene.pieces)
            std::cin >> x.t0 >> x.t1 >> x.kind >> x.a >> x.b >> x.c;
        Landing end = fly(scene, t, side, w);
        std::printf("%s %.17g %.17g %.17g %.17g %.17g\n",
                    names[int(end.kind)], end.t, end.u, end.w, end.peak,
                    end.peak_t);
        std::fflush(stdout);
    }
}

inline double cpu_s() {
    timespec now;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return double(now.tv_sec) + 1e-9 * double(now.tv_nsec);
}

using Flights = std::function<Flight(const Scene&, long&)>;

inline std::vector<std::string> files(const std::string& folder) {
    std::vector<std::string> paths;
    using Entries = std::filesystem::recursive_directory_iterator;
    for (const auto& entry : Entries(folder))
        if (entry.path().extension() == ".txt") paths.push_back(entry.path());
    std::sort(paths.begin(), paths.end());
    return paths;
}

// Runs all levels of all chains and prints one line: time, analyses, and
// chains whose first overturning is not at the last level.
inline void measure_chains(const std::string& label, const std::string& folder,
                           const Flights& flights) {
    double total = 0;
    long count = 0, moved = 0, work = 0;
    for (const auto& path : files(folder)) {
        Scene scene(path);
        bool same = true;
        double begin = cpu_s();
        for (double level : scene.levels) {
            scene.scale(level);
            bool overturned = false;
            try {
                overturned = std::isinf(run(scene, flights(scene, work)).peak);
            } catch (const std::exception& error) {
                std::fprintf(stderr, "%s\n", error.what());
                same = false;
            }
            count++;
            same = same && overturned == (level == scene.levels.back());
            if (overturned) break;
        }
        total += cpu_s() - begin;
        moved += !same;
    }
    std::printf("%s,1,%.4g,%ld,,%ld\n", label.c_str(), total, count, moved);
    std::fflush(stdout);
}

// Runs all cases and prints a line for each; the time is the least of five.
inline void measure(const std::string& label, const std::string& folder,
                    const Flights& flights) {
    for (const auto& path : files(folder)) {
        Scene scene(path);
        double least = 1e300;
        long work = 0;
        Result result{std::nan(""), {}};
        for (int turn = 0; turn < 5; turn++) {
            work = 0;
            Flight flight = flights(scene, work);
            double begin = cpu_s();
            try {
                result = run(scene, flight);
            } catch (const std::exception& error) {
                if (turn == 0) std::fprintf(stderr, "%s\n", error.what());
            }
            least = std::min(least, cpu_s() - begin);
        }
        std::printf("%s,%s,%.9g,%ld,%.17g,%zu,", label.c_str(),
                    scene.name.c_str(), least, work, result.peak,
                    result.impacts.size());
        for (size_t i = 0; i < std::min<size_t>(10, result.impacts.size()); i++)
            std::printf("%s%.17g", i ? " " : "", result.impacts[i]);
        std::printf("\n");
        std::fflush(stdout);
    }
}

inline void header() {
    std::printf("tool,version,method,setting,case,cpu_s,work,peak_ratio,"
                "impacts,first_impacts_s\n");
}
