#!/usr/bin/env bash
# A binary that PoCL gives of a program has no code for work-groups of a size that was not launched before it was read.
#
# One would guess: CL_PROGRAM_BINARIES is what the kernels run, so that a program loaded from it with
# clCreateProgramWithBinary starts without the compiler. PoCL's page on binaries says as much.
# What happens: PoCL compiles each kernel for the size of its work-groups at its first launch. The binary holds what was
# compiled by then, and each kernel for groups of any size, which is not taken where PoCL has its compiler. So a program that
# is stored right after it was built is compiled again when it is loaded and launched; one whose kernels were launched
# once before, with the size that will be used, is not.
# Version: pocl-opencl-icd 3.1-3+deb12u1 (Debian 12). Seen: 2026-11-30.
# Why it matters: a cache of program binaries, as many applications and PyOpenCL keep one, saves the front end alone; what
# takes longest with large kernels is done again by each process that finds $POCL_CACHE_DIR empty.
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

makeRoot bookworm pocl-opencl-icd=3.1-3+deb12u1 ocl-icd-opencl-dev g++-12 binutils

cat >"$root/tmp/probe.cpp" <<'END'
#define CL_TARGET_OPENCL_VERSION 120
#include <CL/cl.h>

#include <fstream>
#include <iterator>
#include <string>
#include <vector>

// probe store|load FILE launch|-: a program of one kernel, launched with groups of 8 where that is said.
int main(int, char** words) {
  const bool stores = words[1] == std::string("store"), launches = words[3] == std::string("launch");
  const char* source = "kernel void twice(global float* a) { a[get_global_id(0)] *= 2; }";
  cl_platform_id platform;
  cl_device_id device;
  if (clGetPlatformIDs(1, &platform, nullptr) != CL_SUCCESS ||
      clGetDeviceIDs(platform, CL_DEVICE_TYPE_ALL, 1, &device, nullptr) != CL_SUCCESS)
    return 2;
  const cl_context context = clCreateContext(nullptr, 1, &device, nullptr, nullptr, nullptr);
  const cl_command_queue queue = clCreateCommandQueue(context, device, 0, nullptr);
  std::vector<unsigned char> binary;
  std::size_t bytes = 0;
  cl_program program = nullptr;
  if (stores) {
    program = clCreateProgramWithSource(context, 1, &source, nullptr, nullptr);
  } else {
    std::ifstream in(words[2], std::ios::binary);
    binary.assign(std::istreambuf_iterator<char>(in), {});
    bytes = binary.size();
    const unsigned char* data = binary.data();
    program = clCreateProgramWithBinary(context, 1, &device, &bytes, &data, nullptr, nullptr);
  }
  if (clBuildProgram(program, 1, &device, "", nullptr, nullptr) != CL_SUCCESS) return 2;
  const cl_kernel kernel = clCreateKernel(program, "twice", nullptr);
  if (launches) {
    const cl_mem buffer = clCreateBuffer(context, CL_MEM_READ_WRITE, 256, nullptr, nullptr);
    clSetKernelArg(kernel, 0, sizeof(buffer), &buffer);
    const std::size_t items = 64, group = 8;
    if (clEnqueueNDRangeKernel(queue, kernel, 1, nullptr, &items, &group, 0, nullptr, nullptr) != CL_SUCCESS) return 2;
    clFinish(queue);
  }
  if (!stores) return 0;
  clGetProgramInfo(program, CL_PROGRAM_BINARY_SIZES, sizeof(bytes), &bytes, nullptr);
  binary.resize(bytes);
  unsigned char* data = binary.data();
  clGetProgramInfo(program, CL_PROGRAM_BINARIES, sizeof(data), &data, nullptr);
  std::ofstream(words[2], std::ios::binary).write(reinterpret_cast<char*>(data), static_cast<std::streamsize>(bytes));
}
END
inRoot g++-12 -O1 /tmp/probe.cpp -o /tmp/probe -lOpenCL

# probe CACHE WORDS…: with that folder of PoCL's, which is made.
probe() {
  local cache=$1
  shift
  mkdir -p "$root/tmp/$cache"
  HOME=/tmp POCL_CACHE_DIR=/tmp/$cache inRoot /tmp/probe "$@"
}
# sizesIn CACHE: the work-group sizes that there is code for.
sizesIn() { (cd "$root/tmp/$1" && find . -name twice.so) | sed -E 's|.*/([^/]*)/twice.so|\1|' | sort | tr '\n' ' '; }

probe one store /tmp/early.bin -
probe two store /tmp/late.bin launch
for binary in early late; do
  probe "$binary" load "/tmp/$binary.bin" -
  loaded=$(sizesIn "$binary")
  probe "$binary" load "/tmp/$binary.bin" launch
  printf '%s.bin: loaded %s, after a launch of groups of 8 %s\n' "$binary" "$loaded" "$(sizesIn "$binary")"
  [[ $binary == late ]] || early=$loaded+$(sizesIn early)
  [[ $binary == early ]] || late=$loaded+$(sizesIn late)
done
special=8-1-1-goffs0-smallgrid
if [[ $early == "0-0-0 +0-0-0 $special " && $late == "0-0-0 $special +0-0-0 $special " ]]; then
  echo 'as described: the early one is compiled again, the late one is not'
else
  echo 'NOT as described'
  exit 1
fi
