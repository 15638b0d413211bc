#!/bin/sh
# Fetches out of Debian 11 what programs for glibc 2.31 are linked against, and a loader of EGL: libc.sh FOLDER
# apt checks their signatures, and neither reads nor changes what is installed here.
set -eu
folder=$(realpath -m "$1")
[ ! -e "$folder/usr/lib/x86_64-linux-gnu/crt1.o" ] || exit 0
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$work/lists/partial" "$work/archives/partial" "$work/deb" "$work/root"
touch "$work/status"
echo "deb [arch=amd64 signed-by=/usr/share/keyrings/debian-archive-keyring.gpg] http://deb.debian.org/debian bullseye main" \
  >"$work/sources.list"
apt() {
  apt-get -q -o Dir::Etc::SourceList="$work/sources.list" -o Dir::Etc::SourceParts=/dev/null -o Dir::State::Lists="$work/lists" \
    -o Dir::Cache="$work" -o Dir::State::Status="$work/status" -o APT::Sandbox::User=root -o Acquire::Languages=none \
    -o Acquire::IndexTargets::deb::DEP-11::DefaultEnabled=false "$@" >&2
}
apt update
(cd "$work/deb" && apt download libc6 libc6-dev libgcc-10-dev libegl1 libglvnd0)
for package in "$work"/deb/*.deb; do dpkg-deb -x "$package" "$work/root"; done
# Links that begin at the root would lead out of the folder.
find "$work/root" -type l -lname '/*' | while read -r link; do
  ln -sfnr "$work/root$(readlink "$link")" "$link"
done
gcc="$work/root/usr/lib/gcc/x86_64-linux-gnu/10"
mkdir "$gcc/eh"
cp "$gcc/libgcc_eh.a" "$gcc/eh/"
mkdir -p "$(dirname "$folder")"
rm -rf "$folder"
mv "$work/root" "$folder"
