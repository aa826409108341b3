# shellcheck shell=bash disable=SC2119,SC2120,SC2154
# Sourced by run.sh, test.sh and .ci/run: installs missing packages, configures and builds build/release.
# Reads `root` (the repository's folder) and cmake/packages.txt; writes under build/ only. It speaks on standard
# error alone, so that standard output stays the program's.
# WHITTLE_CMAKE_ARGS, where set, holds further CMake options; unset leaves a build folder as it was configured.

buildDir=$root/build/release

say() { printf 'whittle: %s\n' "$*" >&2; }

# showProgress LABEL LOG: after a second the step's name, on a terminal then the newest line of its log as well.
# Ends by SIGTERM with status 0 if it said anything. Sleeps by `read`: a `sleep` process would outlive the step.
showProgress() {
  local said=1 line pause
  trap 'exit $said' TERM
  exec {pause}<> <(:)
  read -rt 1 -u "$pause" || true
  said=0
  printf 'whittle: %s … ' "$1" >&2
  while kill -0 $$ 2>/dev/null; do
    if [[ -t 2 ]]; then
      line=$(tail -c 500 -- "$2" | tr '\r\t' '\n ' | tail -n 1) || true
      printf '\r\033[Kwhittle: %s … %.60s' "$1" "$line" >&2
    fi
    read -rt 0.3 -u "$pause" || true
  done
}

# step LABEL LOG COMMAND…: runs the command with its output in LOG. Silent if it is over within a second; if it
# fails, shows the end of LOG and exits. Descriptor 9 is the lock, which no child may keep.
step() {
  local label=$1 log=$2 status=0 start=$SECONDS ticker
  shift 2
  : >"$log"
  showProgress "$label" "$log" 9>&- &
  ticker=$!
  "$@" >"$log" 2>&1 9>&- || status=$?
  kill "$ticker" 2>/dev/null || true
  if wait "$ticker" 2>/dev/null; then
    [[ ! -t 2 ]] || printf '\r\033[Kwhittle: %s … ' "$label" >&2
    if ((status == 0)); then printf '%d s\n' $((SECONDS - start)) >&2; else printf 'failed\n' >&2; fi
  fi
  ((status != 0)) || return 0
  tail -n 40 -- "$log" >&2
  say "$label failed; the whole log is $log"
  exit 1
}

# lockBuild / unlockBuild: one set-up at a time in one checkout.
lockBuild() {
  mkdir -p -- "$root/build"
  exec 9>"$root/build/.lock"
  flock --nonblock 9 && return
  say 'waiting for another run to finish its set-up'
  flock 9
}
unlockBuild() { exec 9>&-; }

# installMissing [ci|experiments]: installs what cmake/packages.txt lists and this machine lacks; with a word the lines
# marked with it too.
installMissing() {
  local name reason wanted=() missing=() admin=()
  command -v dpkg-query >/dev/null || return 0  # not Debian: CMake names what it cannot find
  while read -r name _ reason; do
    [[ -n $name && $name != '#'* ]] || continue
    [[ $reason =~ ^(ci|experiments): && ${BASH_REMATCH[1]} != "${1-}" ]] || wanted+=("$name")
  done <"$root/cmake/packages.txt"
  local installed
  installed=$'\n'$(dpkg-query -W -f '${db:Status-Status} ${Package}\n' "${wanted[@]}" 2>/dev/null || true)$'\n'
  for name in "${wanted[@]}"; do
    [[ $installed == *$'\n'"installed $name"$'\n'* ]] || missing+=("$name")
  done
  ((${#missing[@]})) || return 0
  if ((EUID != 0)); then
    admin=(sudo)
    [[ -t 0 ]] || admin=(sudo --non-interactive)
    if ! command -v sudo >/dev/null || ! "${admin[@]}" true 2>/dev/null; then
      say "cannot install packages without root or sudo; as root: apt-get update && apt-get install ${missing[*]}"
      exit 1
    fi
  fi
  step "installing packages (${#missing[@]})" "$root/build/install.log" aptInstall "${missing[@]}"
}

# aptInstall NAME…: a failed update is only logged, as one unreachable source need not be the one that is needed.
aptInstall() {
  local apt=("${admin[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -y -o DPkg::Lock::Timeout=600)
  "${apt[@]}" update || true
  "${apt[@]}" install --no-install-recommends "$@"
}

# configure: runs CMake where the folder has no configuration, or one of another place or with other options.
configure() {
  local record=$buildDir/configured.txt options key old=''
  [[ ! -f $record ]] || old=$(<"$record")
  options=${WHITTLE_CMAKE_ARGS-${old#*$'\n'}}
  key=$root$'\n'$options
  [[ $key != "$old" || ! -f $buildDir/build.ninja ]] || return 0
  mkdir -p -- "$buildDir"
  rm -f -- "$buildDir/CMakeCache.txt" "$record"
  # shellcheck disable=SC2086  # several options, split at blanks
  step 'configuring' "$root/build/configure.log" cmake -S "$root" --preset release $options
  printf '%s' "$key" >"$record"
}

# setUp [TARGET…]: everything from a fresh machine to the built targets (all of them by default).
setUp() {
  lockBuild
  installMissing
  configure
  NINJA_STATUS='[%f/%t] ' step 'building' "$root/build/build.log" cmake --build "$buildDir" ${1:+--target "$@"}
  unlockBuild
}
