#!/usr/bin/env bash
# Renders the pictures of the README and docs/ again, each by the command that stands beside it there.
set -euo pipefail
cd "$(dirname "$0")/.."
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# one SCENE FRAME VIEW NAME [OPTION...]: one frame of a view as docs/images/NAME.png
one() {
  local scene=$1 frame=$2 view=$3 name=$4
  shift 4
  ./billow render "scenes/$scene.yaml" --frames "$frame" -o "$work/$name" --progress none -D "render.views=[$view]" "$@"
  cp "$work/$name/$view"/frame_*.png "docs/images/$name.png"
}
small=(-D 'render.size=[480, 270]' -D render.samples=8)

one drape 15 textured drape
one drape 15 velocity drape_velocity "${small[@]}"
one irregular 40 textured irregular "${small[@]}"
one two_bodies 30 textured two_bodies "${small[@]}"
one choi_ko 100 textured choi_ko "${small[@]}"
one fish 60 textured fish "${small[@]}"
one sphere 30 textured sphere "${small[@]}" -D duration=1.4
one lace 30 textured lace "${small[@]}" -D duration=1.4
one table 34 textured table "${small[@]}" -D duration=1.5
one flag 60 textured flag "${small[@]}" -D duration=2.5
one curtain 75 textured curtain "${small[@]}" -D duration=3.1
one stack 7 textured stack "${small[@]}" -D duration=0.3
one funnel 29 textured funnel "${small[@]}" -D duration=1.25
# The same fall without a filter, with a force filter and with a velocity filter: the picture at 3.4 s, the strip of 5 s.
filters() {
  local name=$1
  shift
  one drape 86 textured "filter_$name" "${small[@]}" "$@"
  ./billow render scenes/drape.yaml -o "$work/film_$name" --progress none -D duration=5 -D strip.step=0.1 \
    -D 'render.size=[64, 36]' -D 'render.views=[velocity]' -D render.velocity_range=4 "$@"
  cp "$work/film_$name/velocity_strip.png" "docs/images/strip_$name.png"
}
filters none -D solver.filter=none
filters force
filters velocity -D solver.filter.target=velocity
./billow render scenes/drape.yaml -o "$work/film" --progress none -D duration=5 -D strip.step=0.025 -D 'render.size=[64, 36]' -D 'render.views=[velocity]'
cp "$work/film/velocity_strip.png" docs/images/drape_strip.png
# The paper's figures, for docs/figures.md.
mkdir -p docs/images/figures
for study in figure-4 figure-5 figure-6 figure-8 figure-9 work-against-error levels; do
  ./billow study "scenes/studies/$study.yaml" -o "$work/$study"
done
./billow filter scenes/drape.yaml -D solver.filter=none -o "$work/filter"
for picture in figure-4/figure-4 figure-5/figure-5 figure-5/energy-by-frequency figure-6/figure-6 \
  figure-6/velocity-symmetric figure-6/velocity-plain figure-6/force-conserving figure-8/figure-8-particles \
  figure-8/figure-8-stiffness figure-8/figure-8-error figure-9/figure-9 work-against-error/work-1e6 \
  work-against-error/work-1e8 work-against-error/work-1e9 levels/levels filter/response; do
  cp "$work/$picture.png" docs/images/figures/
done
one soft_body 25 textured soft_body "${small[@]}" -D 'render.camera={eye: [0, 0.5, 3.4], look_at: [0, -0.3, 0.1], fov: 26}'
# The model on a run's page, as a browser shows it.
./billow render scenes/table.yaml -o "$work/page" --progress none --cache glb -D duration=1.5 -D 'render.size=[640, 360]'
chromium --headless --no-sandbox --disable-gpu --enable-unsafe-swiftshader --hide-scrollbars --force-device-scale-factor=1 \
  --user-data-dir="$work/chromium" --window-size=1280,2300 --virtual-time-budget=10000 \
  --screenshot="$work/page_3d.png" "file://$work/page/index.html"
ffmpeg -v error -y -i "$work/page_3d.png" -vf crop=1280:688:0:1600 docs/images/page_3d.png
# A turntable, and what of a frame other views say.
./billow render scenes/table.yaml -o "$work/turn" --progress none -D duration=1.2 -D 'render.size=[480, 270]' \
  -D render.samples=8 -D 'render.camera={turntable: 1.2}' -D 'render.views=[textured]'
./billow sheet "$work/turn" -n 8 --columns 4 -o docs/images/turntable.png --overwrite
./billow render scenes/drape.yaml --frames 18 -o "$work/views" --progress none -D 'render.size=[480, 270]' \
  -D 'render.views=[textured, velocity, depth, normal]' -D duration=1
ffmpeg -v error -y -i "$work/views/textured/frame_0018.png" -i "$work/views/velocity/frame_0018.png" \
  -i "$work/views/depth/frame_0018.png" -i "$work/views/normal/frame_0018.png" -filter_complex \
  "[0]format=rgb24[a];[1]format=rgb24[b];[2]format=rgb24[c];[3]format=rgb24[d];[a][b][c][d]xstack=inputs=4:layout=0_0|w0_0|0_h0|w0_h0" \
  docs/images/views.png
# The drape's geometry in other programs, for docs/export.md.
./billow render scenes/drape.yaml --frames 1-40 -o "$work/export" --cache pc2,vtp --progress none -D 'render.size=[64, 36]'
blender -b --factory-startup --python-exit-code 1 --python docs/export_blender.py -- "$work/export/caches" 15 \
  assets/textures/tartan.png docs/images/export_blender.png
xvfb-run -a /usr/bin/python3 docs/export_paraview.py "$work/export/caches/drape.pvd" 15 docs/images/export_paraview.png
