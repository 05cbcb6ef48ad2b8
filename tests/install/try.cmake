# Installs the library into a fresh folder, builds a consumer against it there, and runs it.
#   cmake -D BUILD=... -D WORK=... -D VERSION=... -D CXX=... -D FLAGS=... -P try.cmake
function(run)
  execute_process(COMMAND ${ARGV} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

file(REMOVE_RECURSE ${WORK})
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/prefix)
run(${CMAKE_COMMAND} -G Ninja -S ${CMAKE_CURRENT_LIST_DIR}/consumer -B ${WORK}/build
    -D CMAKE_PREFIX_PATH=${WORK}/prefix -D NDA_VERSION=${VERSION}
    -D CMAKE_CXX_COMPILER=${CXX} "-D CMAKE_CXX_FLAGS=${FLAGS}")
run(${CMAKE_COMMAND} --build ${WORK}/build)
run(${WORK}/build/consumer)
