#!/usr/bin/env bash
# Puts the folder that runs on other machines together, and its archive: pack.sh SOURCE BUILD SCENES
# BUILD: the build of the preset `portable`. SCENES: a folder of scenes with a PROVENANCE.txt each, where there is one.
set -euo pipefail
source_dir="$(realpath "$1")" build="$(realpath "$2")" scenes="${3:-}"
most_archive=$((40 << 20)) most_scenes=$((30 << 20))  # bytes
newest_glibc=2.31

version="$(sed -n 's/^#define GNOMON_VERSION_\(MAJOR\|MINOR\|PATCH\) //p' "$source_dir/include/gnomon/version.hpp" | paste -sd.)"
name="gnomon-$version-linux-x86_64"
folder="$build/$name"
rm -rf "$folder" "$folder.tar.xz"
mkdir -p "$folder"/{bin,lib,licenses,scenes}

cp "$build"/bin/{gnomon,flythrough} "$build"/bin/bench_* "$build/bin/tests/mask_hashes" "$folder/bin/"
cp "$source_dir/packaging/portable/measure_gpu" "$folder/"
cp "$source_dir/packaging/portable/README.md" "$source_dir/LICENSE" "$folder/"
cp -r "$source_dir/tests/data" "$folder/data"
# The loader of EGL, for machines that have a driver and no loader.
cp -L "$build"/libc/usr/lib/x86_64-linux-gnu/{libEGL.so.1,libGLdispatch.so.0} "$folder/lib/"
for package in libglm-dev libfmt-dev libcli11-dev libtinygltf-dev nlohmann-json3-dev libstdc++-12-dev; do
  cp "/usr/share/doc/$package/copyright" "$folder/licenses/$package"
done
cp "$build/libc/usr/share/doc/libglvnd0/copyright" "$folder/licenses/libglvnd"

# Pictures other than PNG are not read there; scenes that do not fit are skipped, the largest first.
if [[ -d $scenes ]]; then
  cp -rL "$scenes"/. "$folder/scenes/"
  chmod -R u+w "$folder/scenes"
  find "$folder/scenes" -iname '*.jp*g' -delete
  while (($(du -sb "$folder/scenes" | cut -f1) > most_scenes)); do
    largest="$(du -sb "$folder"/scenes/* | sort -n | tail -n 1 | cut -f2)"
    echo "pack: left out: $(basename "$largest")" >&2
    rm -rf "$largest"
  done
  for scene in "$folder"/scenes/*; do
    grep -qiE '^ *licen[cs]e: *(CC0|CC-BY-|MIT)' "$scene/PROVENANCE.txt" || { echo "pack: left out for its licence: $scene" >&2; rm -rf "$scene"; }
  done
fi

for program in "$folder"/bin/*; do
  needed="$(objdump -p "$program" | sed -n 's/^ *NEEDED *//p' | grep -vE '^(libc|libm|libdl|libpthread)\.so\.|^ld-linux' || true)"
  [[ -z $needed ]] || { echo "pack: $program needs $needed" >&2; exit 1; }
done
for file in "$folder"/bin/* "$folder"/lib/*; do
  newest="$(objdump -T "$file" | grep -o 'GLIBC_[0-9.]*' | sort -uV | tail -n 1)"
  [[ $(printf '%s\n' "${newest#GLIBC_}" "$newest_glibc" | sort -V | tail -n 1) == "$newest_glibc" ]] ||
    { echo "pack: $file needs $newest" >&2; exit 1; }
done

# What software draws, for measure_gpu to count differences from. Shaders that run once are not worth optimizing; masks are the
# same without.
(cd "$folder" && GALLIVM_PERF=nopt bin/mask_hashes --keep masks.bin >/dev/null)

tar -C "$build" --owner=0 --group=0 --sort=name -cf - "$name" | xz -T0 -6 >"$folder.tar.xz"
size="$(stat -c %s "$folder.tar.xz")"
((size <= most_archive)) || { echo "pack: $folder.tar.xz has $size bytes, more than $most_archive" >&2; exit 1; }
echo "$folder.tar.xz"
