// SUNDIALS CVODE: Adams, functional iteration, root finding; one
// initialisation a flight.
#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_version.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include <memory>

#include "scene.hpp"

struct Data {
    const Scene* scene;
    double side;
    long* work;
};

static int rhs(realtype t, N_Vector x, N_Vector d, void* user) {
    auto* data = static_cast<Data*>(user);
    const Scene& scene = *data->scene;
    ++*data->work;
    NV_Ith_S(d, 0) = NV_Ith_S(x, 1);
    NV_Ith_S(d, 1) =
        scene.acceleration(NV_Ith_S(x, 0), data->side, scene.force(t));
    return 0;
}

static int roots(realtype, N_Vector x, realtype* g, void* user) {
    auto* data = static_cast<Data*>(user);
    g[0] = NV_Ith_S(x, 0);
    g[1] = NV_Ith_S(x, 0) - data->scene->limit;
    g[2] = NV_Ith_S(x, 1);
    return 0;
}

struct Solver {
    Data data;
    SUNContext context;
    N_Vector x, tolerance;
    SUNNonlinearSolver iteration;
    void* memory;

    bool plain;

    // `plain`: with the tolerances of SUNDIALS' examples, no step chosen.
    Solver(const Scene& scene, long& work, double rtol, bool plain = false)
        : data{&scene, 1, &work}, plain(plain) {
        SUNContext_Create(nullptr, &context);
        x = N_VNew_Serial(2, context);
        tolerance = N_VNew_Serial(2, context);
        // Served hops get as low as 1e-12 alpha.
        double least = scene.beyond > 0 ? rtol : rtol * 1e-3;
        NV_Ith_S(tolerance, 0) = plain ? 1e-8 : least * scene.alpha;
        NV_Ith_S(tolerance, 1) = plain ? 1e-8 : least * scene.alpha * scene.p;
        memory = CVodeCreate(CV_ADAMS, context);
        CVodeInit(memory, rhs, 0, x);
        CVodeSVtolerances(memory, rtol, tolerance);
        CVodeSetUserData(memory, &data);
        iteration = SUNNonlinSol_FixedPoint(x, 0, context);
        CVodeSetNonlinearSolver(memory, iteration);
        CVodeRootInit(memory, 3, roots);
        int down[3] = {-1, 1, -1};
        CVodeSetRootDirection(memory, down);
        CVodeSetNoInactiveRootWarn(memory);
        CVodeSetMaxNumSteps(memory, 1000000);
    }
    ~Solver() {
        CVodeFree(&memory);
        SUNNonlinSolFree(iteration);
        N_VDestroy(x);
        N_VDestroy(tolerance);
        SUNContext_Free(&context);
    }

    Landing fly(double t, double side, double w) {
        const Scene& scene = *data.scene;
        data.side = side;
        NV_Ith_S(x, 0) = scene.u;
        NV_Ith_S(x, 1) = w;
        double peak = 0, peak_t = t, step = scene.first_step(w);
        // The forcing jumps at the record's end: begin anew there.
        for (double stop : {scene.end, scene.end + scene.beyond}) {
            if (!(t < stop)) continue;
            CVodeReInit(memory, t, x);
            CVodeSetInitStep(memory, plain ? 0 : std::min(step, stop - t));
            CVodeSetMaxStep(
                memory, !plain && stop <= scene.end ? scene.dt : 0);
            CVodeSetStopTime(memory, stop);
            while (true) {
                int flag = CVode(memory, stop, x, &t, CV_ONE_STEP);
                double u = NV_Ith_S(x, 0);
                // A hop below the tolerance, which root finding has lost.
                if (u < 0 && NV_Ith_S(x, 1) < 0)
                    return {Kind::Impact, t, NV_Ith_S(x, 1), peak, 0, peak_t};
                if (u > peak) peak = u, peak_t = t;
                if (flag == CV_TSTOP_RETURN) break;
                if (flag == CV_SUCCESS) continue;
                if (flag != CV_ROOT_RETURN)
                    return {Kind::Failed, t, 0, peak};
                int found[3];
                CVodeGetRootInfo(memory, found);
                for (int i : {1, 0})
                    if (found[i])
                        return {i ? Kind::Overturned : Kind::Impact,
                                t, NV_Ith_S(x, 1), peak, u, peak_t};
            }
            step = scene.dt;
        }
        Kind kind = scene.beyond > 0 ? Kind::Failed : Kind::Stop;
        return {kind, t, NV_Ith_S(x, 1), peak, NV_Ith_S(x, 0), peak_t};
    }
};

// `cvode FOLDER`, or `cvode serve default|best`.
int main(int argc, char** argv) {
    if (argc > 2) {
        const bool plain = std::string(argv[2]) == "default";
        serve([&](const Scene& scene, double t, double side, double w) {
            long work = 0;
            double rtol = plain ? 1e-4 : 1e-13;
            return Solver(scene, work, rtol, plain).fly(t, side, w);
        });
        return 0;
    }
    header();
    for (const char* rtol : {"1e-06", "1e-09", "1e-12"})
        measure(std::string("SUNDIALS CVODE," SUNDIALS_VERSION ",Adams with "
                            "roots,rtol ") + rtol,
                argv[1], [&](const Scene& scene, long& work) {
                    auto solver = std::make_shared<Solver>(
                        scene, work, std::stod(rtol));
                    return [solver](double t, double side, double w) {
                        return solver->fly(t, side, w);
                    };
                });
}
