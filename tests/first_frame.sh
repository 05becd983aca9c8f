#!/usr/bin/env bash
# A window draws although a robot elsewhere never comes: tests/first_frame.sh TOUCHLINE [--within MILLISECONDS]. Opens it on a display of
# its own, by itself and with such a robot, tells how long the first picture takes, and ends it by Ctrl-C. Fails if that takes longer than
# given, which a machine must be quiet for. Installs the display where there is none; ends with 77 where no window can be had at all.
set -euo pipefail
touchline=$(realpath "$1")
case ${2:-} in
    "") most="" ;;
    --within) most=${3:?milliseconds} ;;
    *) echo "$2 is no option" && exit 2 ;;
esac
cd "$(dirname "$0")/.."

missing=()
for pair in Xvfb:xvfb import:imagemagick; do
    command -v "${pair%%:*}" > /dev/null || missing+=("${pair##*:}")
done
compgen -G '/usr/share/vulkan/icd.d/*.json' > /dev/null || missing+=(mesa-vulkan-drivers)
for library in libxcursor1:libXcursor.so.1 libxi6:libXi.so.6 libxkbcommon-x11-0:libxkbcommon-x11.so.0; do
    grep -q "${library##*:}" <(ldconfig -p) || missing+=("${library%%:*}")
done
if [ ${#missing[@]} -gt 0 ]; then
    { apt-get update --quiet &&
        DEBIAN_FRONTEND=noninteractive apt-get install --yes --quiet --no-install-recommends "${missing[@]}"; } || exit 77
fi

folder=$(mktemp -d)
trap 'kill $(jobs -p) 2> /dev/null || true; rm -rf "$folder"' EXIT
export HOME="$folder" XDG_CONFIG_HOME="$folder"
unset WAYLAND_DISPLAY
exec 3> "$folder/display"
Xvfb -br -noreset -displayfd 3 -screen 0 1280x800x24 2> /dev/null &
display=$!
until [ -s "$folder/display" ]; do
    kill -0 $display || exit 77
done
DISPLAY=:$(cat "$folder/display")
export DISPLAY

# Plays until there is a picture, which has many colours, and a while at most; sets how long it took.
first_picture() {
    # A shell keeps Ctrl-C from what it starts in the background.
    env --default-signal=INT "$touchline" play "$@" > "$folder/said" 2>&1 &
    local window=$! began now colours code=0
    began=$(date +%s%N)
    until colours=$(import -silent -window root -resize 160x100 -format '%k' info:) && [ "${colours:-0}" -gt 50 ]; do
        now=$(date +%s%N)
        if grep -q 'is played headless' "$folder/said"; then
            cat "$folder/said"
            exit 77
        fi
        if ! kill -0 $window 2> /dev/null || [ $((now - began)) -gt 120000000000 ]; then
            cat "$folder/said"
            return 1
        fi
    done
    now=$(date +%s%N)
    took=$(((now - began) / 1000000))
    kill -INT $window
    wait $window || code=$?
    echo "play $*: first picture after $took ms; Ctrl-C ends it with code $code"
    [ $code -eq 130 ]
}

first_picture
alone=$took
first_picture --remote home:1 --patience 3600
if [ -n "$most" ] && { [ "$alone" -gt "$most" ] || [ "$took" -gt "$most" ]; }; then
    echo "longer than $most ms"
    exit 1
fi
