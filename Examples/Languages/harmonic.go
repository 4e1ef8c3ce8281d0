// SPDX-License-Identifier: BSD-3-Clause
//
// A harmonic field on a mesh of any size, in Go: go run harmonic.go bunny.smb bunny.vtu
package main

// #cgo LDFLAGS: -lstreamingmultigrid
// #include <streamingmultigrid.h>
import "C"
import (
	"log"
	"os"
)

func check(status C.smg_status) {
	if status != C.SMG_OK {
		log.Fatal(C.GoString(C.smg_error()))
	}
}

func main() {
	var mesh *C.smg_mesh
	var field *C.smg_field
	job := C.CString(`{"problem": {"dirichlet": [{"vertices": [0], "value": 0},
	                                             {"vertices": [9999], "value": 1}]}}`)
	check(C.smg_open(C.CString(os.Args[1]), nil, nil, nil, &mesh))
	check(C.smg_run(mesh, C.CString("solve"), job, nil, nil, &field))
	check(C.smg_save(field, C.CString(os.Args[2]), nil, nil, nil, nil))
	C.smg_close_field(field)
	C.smg_close_mesh(mesh)
}
