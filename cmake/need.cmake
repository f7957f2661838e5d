# Packages that must be there; where one is missing, the command that installs it.

# _missing(WHAT GROUP): ends the configuration. GROUP: of cmake/install_packages.sh.
function(_missing what group)
  message(FATAL_ERROR "${what} is missing. Install it with: ${PROJECT_SOURCE_DIR}/cmake/install_packages.sh ${group}")
endfunction()

# need(NAME IN GROUP [further arguments of find_package])
macro(need name _in _group)
  find_package(${name} QUIET ${ARGN})
  if(NOT ${name}_FOUND)
    _missing(${name} ${_group})
  endif()
endmacro()

# need_module(PREFIX MODULE IN GROUP): a module of pkg-config, as the target PkgConfig::PREFIX.
macro(need_module prefix module _in _group)
  pkg_check_modules(${prefix} QUIET IMPORTED_TARGET ${module})
  if(NOT ${prefix}_FOUND)
    _missing(${module} ${_group})
  endif()
endmacro()

# need_file(VARIABLE NAME LIBRARY|HEADER IN GROUP)
macro(need_file variable name kind _in _group)
  if("${kind}" STREQUAL "LIBRARY")
    find_library(${variable} ${name})
  else()
    find_path(${variable} ${name})
  endif()
  if(NOT ${variable})
    _missing(${name} ${_group})
  endif()
endmacro()
