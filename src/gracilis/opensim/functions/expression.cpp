#include <gracilis/opensim/functions/expression.hpp>

#include <gracilis/core/errors.hpp>

#include <muParser.h>

#include <cmath>

namespace gracilis::opensim {

static double natural_log(double x) { return std::log(x); }
static double square(double x) { return x * x; }
static double cube(double x) { return x * x * x; }
static double recip(double x) { return 1 / x; }
static double step(double x) { return x >= 0 ? 1 : 0; }

Real value(const std::string& formula, const Variables& variables) {
  try {
    mu::Parser parser;
    parser.DefineFun("log", natural_log);
    parser.DefineFun("square", square);
    parser.DefineFun("cube", cube);
    parser.DefineFun("recip", recip);
    parser.DefineFun("step", step);
    for (const auto& [name, number] : variables) parser.DefineConst(name, number);
    parser.SetExpr(formula);
    return parser.Eval();
  } catch (const mu::Parser::exception_type& error) {
    throw InputError({"", "", "the expression '" + formula + "' is not understood: " + error.GetMsg(), ""});
  }
}

}  // namespace gracilis::opensim
