#!/bin/sh
# Writes the tables of samples/BENCHMARKS.md that ask how right pictures of the project's own scenes are, as
# markdown. References are rendered once and kept; they and all pictures lie in build/benchmarks/.
# shellcheck disable=SC2016 # the tables' quotes are markdown's
set -eu
cd "$(dirname "$0")/../.."
. samples/benchmarks/tables.sh

usage() {
    cat <<'END'
usage: samples/benchmarks/accuracy.sh [TABLE...]     after ./quickstart build

  frames    errors after the same number of frames, by nrc and by pt
  seconds   errors after the same seconds, by pt and by nrc, from a cold start
  learning  error of the cache at the first hit after few frames

Without a name all three are written. Environment: SCENES (names, default all that have indirect light),
REFERENCE_FRAMES (16384), FRAMES (256), EACH (60 seconds).
END
}

scenes=${SCENES:-cornell-box door-room lamp-gallery glossy-room}
reference_frames=${REFERENCE_FRAMES:-16384}
frames=${FRAMES:-256}
each=${EACH:-60}
folder=build/benchmarks

# render SCENE OUT OPTIONS...: 128 x 128, 64 bounces. Another seed than the default's makes references independent.
render() {
    scene=$1
    out=$2
    shift 2
    [ ! -e "build/scenes/$scene.json" ] || set -- --camera "build/scenes/$scene.json" "$@"
    build/bin/irradia render "build/scenes/$scene.glb" -o "$out" --size 128x128 --max-bounces 64 --progress none \
        "$@" >$folder/log 2>&1 || {
        cat $folder/log >&2
        exit 70
    }
}

# Sets `reference`: the repository's, or one rendered here.
reference_of() { # SCENE
    reference=samples/images/$1.exr
    [ ! -e "$reference" ] || return 0
    reference=$folder/$1-$reference_frames.exr
    [ -e "$reference" ] || render "$1" "$reference" --method pt --seed 20 --frames "$reference_frames"
}

error() { # METRIC PICTURE
    build/bin/irradia compare --json "$2" "$reference" | sed -n 's/.*"'"$1"'" *: *\([^,}]*\).*/\1/p'
}

frames_table() {
    echo "| scene | mean | relMSE | \`pt\`: relMSE |"
    echo "|---|---|---|---|"
    for scene in $scenes; do
        reference_of "$scene"
        render "$scene" $folder/nrc.exr --method nrc --preset balanced --warmup 64 --frames "$frames"
        render "$scene" $folder/pt.exr --method pt --frames "$frames"
        LC_ALL=C printf '| `%s` | %.3f | %.2g | %.2g |\n' "$scene" "$(error mean_ratio $folder/nrc.exr)" \
            "$(error relmse $folder/nrc.exr)" "$(error relmse $folder/pt.exr)"
    done
}

seconds_table() {
    echo "| scene | \`pt\`: relMSE | \`nrc\`: relMSE |"
    echo "|---|---|---|"
    for scene in $scenes; do
        reference_of "$scene"
        # What compiling the kernels takes is in neither's seconds.
        render "$scene" $folder/warm.exr --method pt --frames 1
        render "$scene" $folder/warm.exr --method nrc --warmup 1 --frames 1
        render "$scene" $folder/pt.exr --method pt --time "$each"
        render "$scene" $folder/nrc.exr --method nrc --preset balanced --warmup 64 --time "$each"
        LC_ALL=C printf '| `%s` | %.2g | %.2g |\n' "$scene" "$(error relmse $folder/pt.exr)" \
            "$(error relmse $folder/nrc.exr)"
    done
}

learning_table() {
    echo "| scene, preset | 1 frame | 4 | 16 | 64 |"
    echo "|---|---|---|---|---|"
    for scene in $scenes; do
        reference_of "$scene"
        for preset in fast balanced faithful; do
            printf '| `%s`, `%s` |' "$scene" $preset
            for learned in 1 4 16 64; do
                render "$scene" $folder/view.exr --method cache-view --preset $preset --warmup $learned --frames 1
                LC_ALL=C printf ' %.2f |' "$(error mape $folder/view.exr)"
            done
            echo
        done
    done
}

write_tables "frames seconds learning" "$@"
