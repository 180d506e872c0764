# For scripts that take a file out of a package of Debian: `. deploy/unpack_package.sh`, then
#   unpack_package PACKAGE FOLDER     unpacks the package, which need not be installed, into the folder, which must not be there
# Images of Debian that leave out /usr/share/doc leave out such files, too, however often the package is installed.

fail() {
  echo "$(basename "$0" .sh): $*" >&2
  exit 2
}

unpack_package() {
  local package=$1 folder=$2
  (mkdir "$folder" && cd "$folder" && apt-get -qq download "$package" >log 2>&1) ||
    fail "apt-get download $package failed: $(grep -m 1 '^E:' "$folder/log" || tail -n 1 "$folder/log")"
  dpkg-deb -x "$folder"/*.deb "$folder/unpacked" || fail "the package $package cannot be unpacked"
}
