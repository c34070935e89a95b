/// What VTK, gmsh and UDUNITS-2 themselves leak when they give up on malformed input, by the function that allocated it:
/// everything else that is not freed still counts as a leak of ours.
#pragma once

// NOLINTNEXTLINE(bugprone-reserved-identifier): the name LeakSanitizer looks for.
extern "C" const char* __lsan_default_suppressions() {
    return "leak:vtkArrayIteratorTemplate\n"
           "leak:MElementFactory::create\n"
           "leak:GModel::_readMSH\n"
           "leak:utlex\n";
}
