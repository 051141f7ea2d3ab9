#!/bin/sh
# Writes the tables of samples/BENCHMARKS.md that compare --sampler sobol with --sampler random, as markdown. All pictures lie
# in build/benchmarks/.
# shellcheck disable=SC2016 # the tables' quotes are markdown's
set -eu
cd "$(dirname "$0")/../.."
. samples/benchmarks/tables.sh

usage() {
    cat <<'END'
usage: samples/benchmarks/sampling.sh [TABLE...]     after ./quickstart build

  worth     variance x time, sobol over random: the median of pairs of seeds, the least and the largest, without the
            largest hundredth of the pixels; the mean of pairs with all of them; the time of a frame alone
  samples   variance after so many samples, sobol and random

Without a name both are written. Environment: SCENES (names, or .glb files with a camera file beside them, default
cornell-box and door-room), METHODS (nrc pt), PAIRS (3), FRAMES (96).
END
}

scenes=${SCENES:-cornell-box door-room}
methods=${METHODS:-nrc pt}
pairs=${PAIRS:-3}
frames=${FRAMES:-96}
folder=build/benchmarks

# render SCENE OUT OPTIONS...: 128 x 128, 32 bounces.
render() {
    scene=$1
    out=$2
    shift 2
    [ -e "$scene" ] || scene=build/scenes/$scene.glb
    [ ! -e "${scene%.glb}.json" ] || set -- --camera "${scene%.glb}.json" "$@"
    build/bin/irradia render "$scene" -o "$out" --size 128x128 --max-bounces 32 --progress none \
        --stats $folder/stats.json "$@" >$folder/log 2>&1 || {
        cat $folder/log >&2
        exit 70
    }
}

milliseconds() {
    sed -n '/"milliseconds"/,/}/s/.*"total": *\([0-9.e+-]*\).*/\1/p' $folder/stats.json
}

# Sets `reference`, what noise is relative to: with little noise of its own, and by neither sampler's pictures.
reference_of() { # SCENE
    reference=$folder/$(basename "$1" .glb)-nrc-512.exr
    [ -e "$reference" ] || render "$1" "$reference" --method nrc --seed 1000 --frames 512
}

# Pictures of one method by both samplers, in turn: $folder/SAMPLER-SEED.exr, and .ms with a frame's time.
pictures_of() { # SCENE METHOD FRAMES SEEDS
    for seed in $(seq 1 "$4"); do
        for sampler in random sobol; do
            render "$1" $folder/$sampler-"$seed".exr --method "$2" --frames "$3" --seed "$seed" --sampler $sampler
            milliseconds >$folder/$sampler-"$seed".ms
        done
    done
}

noise() { # SAMPLER SEED: of it and the next
    build/bin/pictures noise $folder/"$1"-"$2".exr $folder/"$1"-$(($2 + 1)).exr "$reference"
}

frame_time() { # SAMPLER SEED: of its frames and those of the next
    cat $folder/"$1"-"$2".ms $folder/"$1"-$(($2 + 1)).ms | awk '{ sum += $1 } END { print sum }'
}

worth_table() {
    echo "| scene, method | variance × time | all pixels | time |"
    echo "|---|---|---|---|"
    for scene in $scenes; do
        reference_of "$scene"
        for method in $methods; do
            pictures_of "$scene" "$method" "$frames" $((2 * pairs))
            for pair in $(seq 1 2 $((2 * pairs))); do
                echo "$(noise sobol "$pair") $(noise random "$pair")" \
                    "$(frame_time sobol "$pair") $(frame_time random "$pair")"
            done | awk '{ print $1 / $3 * $5 / $6, $2 / $4 * $5 / $6, $5 / $6 }' | sort -g >$folder/pairs
            awk -v what="\`$(basename "$scene" .glb)\`, \`$method\`" -v pairs="$pairs" '
                { worth[NR] = $1; all += $2 / pairs; time += $3 / pairs }
                END { printf "| %s | %.2f (%.2f to %.2f) | %.2f | %.2f |\n",
                          what, worth[int((NR + 1) / 2)], worth[1], worth[NR], all, time }' $folder/pairs
        done
    done
}

samples_table() {
    echo "| scene, method, sampler | 1 sample | 4 | 16 | 64 | 256 |"
    echo "|---|---|---|---|---|---|"
    for scene in $scenes; do
        reference_of "$scene"
        for method in $methods; do
            random=''
            sobol=''
            for samples in 1 4 16 64 256; do
                pictures_of "$scene" "$method" $samples 2
                random="$random $(LC_ALL=C printf '%.2g |' "$(noise random 1 | cut -d " " -f 1)")"
                sobol="$sobol $(LC_ALL=C printf '%.2g |' "$(noise sobol 1 | cut -d " " -f 1)")"
            done
            echo "| \`$(basename "$scene" .glb)\`, \`$method\`, random |$random"
            echo "| the same, sobol |$sobol"
        done
    done
}

write_tables "worth samples" "$@"
