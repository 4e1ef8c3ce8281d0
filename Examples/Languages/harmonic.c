/* SPDX-License-Identifier: BSD-3-Clause
 *
 * A harmonic field on a mesh of any size, in C: cc harmonic.c -lstreamingmultigrid
 *
 *   harmonic bunny.smb bunny.vtu
 */
#include <streamingmultigrid.h>

#include <stdio.h>

int main(int argc, char** argv)
{
  const char* const job = "{\"problem\": {\"dirichlet\": [{\"vertices\": [0], \"value\": 0},"
                          "                           {\"vertices\": [9999], \"value\": 1}]}}";
  smg_mesh* mesh = NULL;
  smg_field* field = NULL;
  int failed = argc != 3 || smg_open(argv[1], NULL, NULL, NULL, &mesh) ||
               smg_run(mesh, "solve", job, NULL, NULL, &field) ||
               smg_save(field, argv[2], NULL, NULL, NULL, NULL);
  if (failed)
    fprintf(stderr, "%s\n", argc == 3 ? smg_error() : "usage: harmonic IN OUT");
  smg_close_field(field);
  smg_close_mesh(mesh);
  return failed;
}
