#!/usr/bin/env bash
# PoCL answers the same to every kernel that asks what it needs of private memory, and how large a group may be.
#
# One would guess: CL_KERNEL_PRIVATE_MEM_SIZE is what a work item of that kernel needs, CL_KERNEL_WORK_GROUP_SIZE the
# largest group that this kernel can run in, as the OpenCL specification has it. Whoever asks before a launch is safe.
# What happens: 1024 bytes and 4096 items, for a kernel that keeps one float of each item across a barrier as for one
# that keeps 512 of them. What they really take is on the stack of the thread that runs the group: 13 and 2076 bytes an
# item here, so that 4096 items of the second need more than the 8 MB that threads have by default.
# Version: pocl-opencl-icd 3.1-3+deb12u1 (Debian 12). Seen: 2026-11-30.
# Why it matters: nothing but the compiled kernel's frame, or a stack made large enough before the first OpenCL call
# (pthread_setattr_default_np), keeps a large work-group from ending the process.
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

#include <cstdio>
#include <string>
#include <vector>

// Two kernels that keep 1 and 512 floats of each work item alive across a barrier.
int main() {
  const std::string text =
      "#define KERNEL(name, n) kernel void name(global float* a) { float own[n]; const int i = get_global_id(0);"
      "  for (int k = 0; k < n; ++k) own[k] = a[i] * k; barrier(CLK_GLOBAL_MEM_FENCE);"
      "  float sum = 0; for (int k = 0; k < n; ++k) sum += own[(k * 7 + i) % n]; a[i] = sum; }\n"
      "KERNEL(few, 1) KERNEL(many, 512)";
  cl_platform_id platform;
  cl_device_id device;
  if (clGetPlatformIDs(1, &platform, nullptr) != CL_SUCCESS ||
      clGetDeviceIDs(platform, CL_DEVICE_TYPE_ALL, 1, &device, nullptr) != CL_SUCCESS)
    return 2;
  const cl_context context = clCreateContext(nullptr, 1, &device, nullptr, nullptr, nullptr);
  const cl_command_queue queue = clCreateCommandQueue(context, device, 0, nullptr);
  const char* source = text.c_str();
  const cl_program program = clCreateProgramWithSource(context, 1, &source, nullptr, nullptr);
  if (clBuildProgram(program, 1, &device, "", nullptr, nullptr) != CL_SUCCESS) return 2;
  std::vector<float> values(64, 1);
  const cl_mem buffer = clCreateBuffer(context, CL_MEM_COPY_HOST_PTR, 256, values.data(), nullptr);
  for (const char* name : {"few", "many"}) {
    const cl_kernel kernel = clCreateKernel(program, name, nullptr);
    cl_ulong bytes = 0;
    size_t group = 0;
    clGetKernelWorkGroupInfo(kernel, device, CL_KERNEL_PRIVATE_MEM_SIZE, sizeof(bytes), &bytes, nullptr);
    clGetKernelWorkGroupInfo(kernel, device, CL_KERNEL_WORK_GROUP_SIZE, sizeof(group), &group, nullptr);
    clSetKernelArg(kernel, 0, sizeof(buffer), &buffer);
    const size_t items = 64;
    if (clEnqueueNDRangeKernel(queue, kernel, 1, nullptr, &items, &items, 0, nullptr, nullptr) != CL_SUCCESS) return 2;
    clFinish(queue);
    std::printf("%s %llu %zu\n", name, static_cast<unsigned long long>(bytes), group);
  }
}
END
mkdir "$root/tmp/cache"
inRoot g++-12 -O1 /tmp/probe.cpp -o /tmp/probe -lOpenCL
answers=$(HOME=/tmp POCL_CACHE_DIR=/tmp/cache inRoot /tmp/probe)
printf 'kernel, CL_KERNEL_PRIVATE_MEM_SIZE, CL_KERNEL_WORK_GROUP_SIZE:\n%s\n' "$answers"

# frameOf KERNEL: the largest stack frame of its compiled code, bytes.
frameOf() {
  local file
  file=$(cd "$root" && find tmp/cache -name "$1.so")
  inRoot objdump -d --no-show-raw-insn "/$file" | grep -oE 'sub +\$0x[0-9a-f]+,%rsp' |
    while IFS='$,' read -r _ bytes _; do echo $((bytes)); done | sort -n | tail -n 1
}
few=$(frameOf few) many=$(frameOf many)
echo "frame of a group of 64 items: $few bytes and $many bytes"
if [[ $answers == $'few 1024 4096\nmany 1024 4096' ]] && ((many > 50 * few && many > 64 * 1024)); then
  echo "as described: the answers are the same, the kernels are not"
else
  echo "NOT as described"
  exit 1
fi
