// Bad inputs in tables: what the program is given, and what its one message has.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/apps/program.hpp"

namespace hemoflux::apps {

/// One bad input. The case is written to case.toml, the file (if any) beside it.
struct Bad {
    std::string text;                ///< the case
    std::vector<std::string> parts;  ///< what the message has
    int code = 2;
    std::string file = {}, content = {};
};

class BadInput : public Program {
  protected:
    void expect_refused(const std::vector<Bad>& all,
                        const std::string& command = "run case.toml -o out") const {
        for (const Bad& bad : all) {
            write("case.toml", bad.text);
            if (!bad.file.empty()) write(bad.file, bad.content);
            const std::string message = expect_error(command, bad.code, bad.parts.at(0));
            for (const std::string& part : bad.parts)
                EXPECT_NE(message.find(part), std::string::npos)
                    << "\"" << part << "\" is not in: " << message;
            EXPECT_FALSE(fs::exists(folder_ / "out")) << message;
            if (!bad.file.empty()) fs::remove(folder_ / bad.file);
        }
    }
};

/// A cell on a small grid.
inline std::string cell_with(const std::string& from, const std::string& to) {
    std::string text = example_case;
    const auto put = [&text](const std::string& a, const std::string& b) {
        const auto at = text.find(a);
        ASSERT_NE(at, std::string::npos) << a;
        text.replace(at, a.size(), b);
    };
    put(from, to);
    const auto nodes = text.find("nodes = 2562");
    if (nodes != std::string::npos) text.replace(nodes, 12, "nodes = 162");
    return text;
}

inline const std::string shear_flow = R"(title = "Shear"
kind = "fluid"
[fluid]
viscosity = "1 mPa s"
[grid]
length = ["4 um", "8 um", "4 um"]
cells = [4, 8, 4]
[boundary]
x = "periodic"
z = "periodic"
y = { velocity = "shear" }
[shear]
rate = "1e4 1/s"
[time]
strain = 0.1
)";

inline std::string flow_with(const std::string& from, const std::string& to) {
    std::string text = shear_flow;
    const auto at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return text.replace(at, from.size(), to);
}

}  // namespace hemoflux::apps
