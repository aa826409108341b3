#!/usr/bin/env bash
# On Mesa 22.3's rusticl a loop within another counts once more than it runs: one that never runs halves how far the outer gets.
#
# One would guess: a loop whose body is not run once costs nothing. Whoever knows that llvmpipe ends loops after 65535
# iterations keeps a loop below that, and a loop inside it that has nothing to do for these values changes nothing.
# What happens: the outer loop of 60000 iterations ends, without a word, after 32768: each of them counts as two, since the
# check that finds the inner loop empty counts as an iteration of it. Without the inner loop all 60000 are done.
# Version: mesa-opencl-icd 22.3.6-1+deb12u2 (Debian 12). Seen: 2026-12-01.
# Why it matters: bounds on loops that are kept by counting what bodies do are off by up to a factor of two; count the entries
# of every inner loop too, or leave half.
# Exit status: 0 as described, 1 behaviour changed, 2 cannot be had here.
# shellcheck disable=SC2016
set -euo pipefail
((EUID == 0)) || { echo "needs root, for chroot" >&2; exit 2; }
tmp=$(mktemp -d)
trap 'rm -rf --one-file-system "$tmp"' EXIT
root=$tmp/root

# makeRoot SUITE PACKAGES…: unpacks them, and what they depend on, into $root. Nothing is installed; no maintainer script runs.
makeRoot() {
  local suite=$1 site deb
  shift
  site=$(apt-get indextargets --format '$(SITE)|$(CODENAME)' 'Created-By: Packages' | sed -n 's/|bookworm$//p' | head -n 1)
  mkdir -p "$tmp"/{none,lists/partial,archives/partial} "$root"/{usr/{bin,sbin,lib,lib64},dev,proc,sys,tmp,root}
  for dir in bin sbin lib lib64; do ln -s usr/$dir "$root/$dir"; done
  printf 'deb [signed-by=/usr/share/keyrings/debian-archive-keyring.gpg] %s %s main\n' "$site" "$suite" > "$tmp/sources.list"
  : > "$tmp/status"
  # what the machine has apt do after an update (to its own caches) is none of this root's business
  { cat /etc/apt/apt.conf || true; printf '#clear APT::Update::Post-Invoke%s;\n' "" -Success; } > "$tmp/main.conf" 2> /dev/null
  echo "Dir::Etc::Main \"$tmp/main.conf\";" > "$tmp/apt.conf"
  local apt=(env APT_CONFIG="$tmp/apt.conf" apt-get -qq -o Dir::Etc::SourceList="$tmp/sources.list" -o Dir::Etc::SourceParts="$tmp/none"
    -o Dir::Etc::Preferences="$tmp/none/p" -o Dir::Etc::PreferencesParts="$tmp/none" -o Dir::State::Lists="$tmp/lists"
    -o Dir::State::Status="$tmp/status" -o Dir::State::extended_states="$tmp/extended" -o Dir::Cache="$tmp"
    -o Dir::Cache::Archives="$tmp/archives" -o APT::Sandbox::User=root)
  "${apt[@]}" update
  "${apt[@]}" install --download-only --no-install-recommends -y "$@" > /dev/null
  for deb in "$tmp"/archives/*.deb; do dpkg-deb --fsys-tarfile "$deb" | tar -x -C "$root" --keep-directory-symlink; done
  rm -f "$tmp"/archives/*.deb
  mknod -m 666 "$root/dev/null" c 1 3
  mknod -m 666 "$root/dev/zero" c 1 5
  mknod -m 666 "$root/dev/urandom" c 1 9
}

# inRoot COMMAND…: runs it there, with a /proc and a /sys that go away with it.
inRoot() {
  unshare --mount --propagation private sh -c 'mount -t proc proc "$0/proc" && mount --rbind /sys "$0/sys" && exec chroot "$0" "$@"' "$root" "$@"
}

makeRoot bookworm mesa-opencl-icd=22.3.6-1+deb12u2 ocl-icd-opencl-dev opencl-headers gcc-12 libc6-dev coreutils ||
  { echo "cannot be had here" >&2; exit 2; }

cat > "$root/tmp/probe.c" << 'END'
#define CL_TARGET_OPENCL_VERSION 120
#include <CL/cl.h>
#include <stdio.h>
/* Where the generator stands tells how often it was asked: no compiler puts a product in the place of the loop. */
static const char* source =
    "__kernel void alone(uint outer, uint inner, __global uint* x) {\n"
    "  uint s = x[0]; for (uint k = 0; k < outer; ++k) s = s * 1664525u + 1013904223u; x[0] = s; }\n"
    "__kernel void around(uint outer, uint inner, __global uint* x) {\n"
    "  uint s = x[0];\n"
    "  for (uint k = 0; k < outer; ++k) {\n"
    "    s = s * 1664525u + 1013904223u;\n"
    "    for (uint m = 0; m < inner; ++m) s = s * 1664525u + 1013904223u; }\n"
    "  x[0] = s; }\n";
int main(void) {
  cl_platform_id platforms[8]; cl_uint found = 0; cl_device_id device = 0;
  clGetPlatformIDs(8, platforms, &found);
  for (cl_uint i = 0; i < found && !device; ++i)
    if (clGetDeviceIDs(platforms[i], CL_DEVICE_TYPE_ALL, 1, &device, NULL) != CL_SUCCESS) device = 0;
  if (!device) { puts("no device"); return 2; }
  cl_int e; cl_context context = clCreateContext(NULL, 1, &device, NULL, NULL, &e);
  cl_command_queue queue = clCreateCommandQueue(context, device, 0, &e);
  cl_program program = clCreateProgramWithSource(context, 1, &source, NULL, &e);
  if (clBuildProgram(program, 1, &device, "", NULL, NULL) != CL_SUCCESS) return 2;
  const char* names[2] = {"alone", "around"}; cl_uint done[2];
  for (int k = 0; k < 2; ++k) {
    cl_uint state = 1, outer = 60000, inner = 0; size_t one = 1;
    cl_kernel kernel = clCreateKernel(program, names[k], &e);
    cl_mem buffer = clCreateBuffer(context, CL_MEM_COPY_HOST_PTR, 4, &state, &e);
    clSetKernelArg(kernel, 0, 4, &outer); clSetKernelArg(kernel, 1, 4, &inner); clSetKernelArg(kernel, 2, sizeof buffer, &buffer);
    clEnqueueNDRangeKernel(queue, kernel, 1, NULL, &one, &one, 0, NULL, NULL);
    clEnqueueReadBuffer(queue, buffer, CL_TRUE, 0, 4, &state, 0, NULL, NULL);
    done[k] = 0;
    for (cl_uint s = 1; s != state && done[k] < outer; ++done[k]) s = s * 1664525u + 1013904223u;
    printf("%s: %u of %u iterations\n", names[k], done[k], outer);
  }
  return done[0] == 60000 && done[1] == 32768 ? 0 : 1;
}
END
inRoot gcc-12 -O1 /tmp/probe.c -o /tmp/probe -lOpenCL
status=0
inRoot env RUSTICL_ENABLE=swrast MESA_SHADER_CACHE_DISABLE=1 HOME=/tmp OCL_ICD_VENDORS=/etc/OpenCL/vendors /tmp/probe || status=$?
case $status in
  0) echo "as described: the loop within, which never runs, halves the loop around it" ;;
  2) echo "cannot be had here"; exit 2 ;;
  *) echo "NOT as described"; exit 1 ;;
esac
