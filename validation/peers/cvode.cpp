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
    double u = NV_Ith_S(x, 0), y = scene.alpha - u;
    ++*data->work;
    NV_Ith_S(d, 0) = NV_Ith_S(x, 1);
    NV_Ith_S(d, 1) = -scene.p * scene.p *
                     (std::sin(y) + data->side * scene.force(t) * std::cos(y));
    return 0;
}

static int roots(realtype, N_Vector x, realtype* g, void* user) {
    auto* data = static_cast<Data*>(user);
    g[0] = NV_Ith_S(x, 0);
    g[1] = NV_Ith_S(x, 0) - data->scene->alpha;
    g[2] = NV_Ith_S(x, 1);
    return 0;
}

struct Solver {
    Data data;
    SUNContext context;
    N_Vector x, tolerance;
    SUNNonlinearSolver iteration;
    void* memory;

    Solver(const Scene& scene, long& work, double rtol)
        : data{&scene, 1, &work} {
        SUNContext_Create(nullptr, &context);
        x = N_VNew_Serial(2, context);
        tolerance = N_VNew_Serial(2, context);
        NV_Ith_S(tolerance, 0) = rtol * scene.alpha;
        NV_Ith_S(tolerance, 1) = rtol * scene.alpha * scene.p;
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
        NV_Ith_S(x, 0) = 0;
        NV_Ith_S(x, 1) = w;
        double peak = 0, step = scene.first_step(w);
        // The forcing jumps at the record's end: begin anew there.
        for (double stop : {scene.end, scene.end + 60}) {
            if (!(t < stop)) continue;
            CVodeReInit(memory, t, x);
            CVodeSetInitStep(memory, std::min(step, stop - t));
            CVodeSetMaxStep(memory, stop <= scene.end ? scene.dt : 0);
            CVodeSetStopTime(memory, stop);
            while (true) {
                int flag = CVode(memory, stop, x, &t, CV_ONE_STEP);
                double u = NV_Ith_S(x, 0);
                // A hop below the tolerance, which root finding has lost.
                if (u < 0 && NV_Ith_S(x, 1) < 0)
                    return {Kind::Impact, t, NV_Ith_S(x, 1), peak};
                peak = std::max(peak, u);
                if (flag == CV_TSTOP_RETURN) break;
                if (flag == CV_SUCCESS) continue;
                if (flag != CV_ROOT_RETURN)
                    return {Kind::Failed, t, 0, peak};
                int found[3];
                CVodeGetRootInfo(memory, found);
                if (found[1])
                    return {Kind::Overturned, t, NV_Ith_S(x, 1), peak};
                if (found[0])
                    return {Kind::Impact, t, NV_Ith_S(x, 1), peak};
            }
            step = scene.dt;
        }
        return {Kind::Failed, t, 0, peak};
    }
};

int main(int, char** argv) {
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
