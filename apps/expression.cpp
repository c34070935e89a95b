#include "apps/expression.hpp"

#include <fmt/format.h>
#include <muParser.h>

#include <memory>

#include "exchange/error.hpp"

namespace hemoflux::apps {
namespace {

/// A parser and the variables it points to.
struct Formula {
    mu::Parser parser;
    double x = 0, y = 0, z = 0, t = 0;
};

}  // namespace

std::function<double(const Vec3d&, double)> expression(const std::string& text, const std::string& where) {
    for (std::size_t i = text.find('='); i != std::string::npos; i = text.find('=', i + 1)) {
        const bool compares = (i > 0 && std::string("=<>!").find(text[i - 1]) != std::string::npos) ||
                              (i + 1 < text.size() && text[i + 1] == '=');
        if (!compares)
            throw InputError(fmt::format("{} = \"{}\"", where, text), "it assigns a value to a variable",
                             "Write a formula of x, y, z in m and t in s; == compares");
    }
    const auto formula = std::make_shared<Formula>();
    try {
        formula->parser.DefineVar("x", &formula->x);
        formula->parser.DefineVar("y", &formula->y);
        formula->parser.DefineVar("z", &formula->z);
        formula->parser.DefineVar("t", &formula->t);
        formula->parser.SetExpr(text);
        static_cast<void>(formula->parser.Eval());
    } catch (const mu::Parser::exception_type& error) {
        std::string message = error.GetMsg();
        while (!message.empty() && message.back() == '.') message.pop_back();
        throw InputError(fmt::format("{} = \"{}\"", where, text), message,
                         "Write a formula of x, y, z in m and t in s, e.g. \"0.1*sin(2*_pi*t)*y\"");
    }
    return [formula](const Vec3d& x, double t) {
        formula->x = x.x, formula->y = x.y, formula->z = x.z, formula->t = t;
        return formula->parser.Eval();
    };
}

}  // namespace hemoflux::apps
