// palpate-render: the eye. See render_loop.h.
#include "common/process/node_main.h"
#include "render_node/render_loop.h"

int main(int argc, char** argv) {
  return palpate::node_main(argc, argv, "palpate-render", palpate::render::run_render);
}
