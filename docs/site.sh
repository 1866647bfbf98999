#!/usr/bin/env bash
# Builds the manual as one static site in out/site: README, guide, background, a page per command, the API reference.
# It opens from the disk (out/site/index.html) and loads nothing from elsewhere. OUT says another folder than out, GRACILIS another program.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

missing=()
for package in mkdocs mkdocs-material doxygen libjs-mathjax mandoc; do
  [[ $(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null) == installed ]] || missing+=("$package")
done
if [[ ${#missing[@]} -gt 0 ]]; then
  echo "The site needs: apt-get install --no-install-recommends ${missing[*]}" >&2
  exit 1
fi
gracilis=${GRACILIS:-build/release/bin/gracilis}
if [[ ! -x $gracilis ]]; then
  echo "$gracilis is not there, whose pages for man the site shows: cmake --preset release && ninja -C build/release gracilis_program" >&2
  exit 1
fi

out=$(realpath -m "${OUT:-out}")
mkdir -p $out
/usr/bin/python3 docs/site/pages.py $out/site_pages "$gracilis"
mkdocs build --quiet --clean --config-file $out/mkdocs.yml

api() { # NAME=VALUE...: Doxygen with these settings, too
  { cat docs/site/Doxyfile; printf '%s\n' "$@"; } | doxygen -
}
api OUTPUT_DIRECTORY=$out/site HTML_OUTPUT=api GENERATE_TAGFILE=$out/api.tag WARN_LOGFILE=$out/api.log
api EXTRACT_ALL=NO GENERATE_HTML=NO WARN_LOGFILE=$out/api_undocumented.log 2>/dev/null
# What shows formulas, without what other ways of drawing them need.
mkdir -p $out/site/api/mathjax/jax/output $out/site/api/mathjax/fonts/HTML-CSS/TeX
(cd /usr/share/javascript/mathjax && cp -rL MathJax.js extensions "$out/site/api/mathjax" &&
  cp -rL jax/input jax/element "$out/site/api/mathjax/jax" && cp -rL jax/output/HTML-CSS "$out/site/api/mathjax/jax/output" &&
  cp -rL fonts/HTML-CSS/TeX/woff "$out/site/api/mathjax/fonts/HTML-CSS/TeX")
functions=$(grep -c '<member kind="function"' $out/api.tag)
without=$(grep -c '(function).*is not documented' $out/api_undocumented.log || true)
warnings=$(wc -l <$out/api.log)
echo "API reference: $functions functions, $without of them without a comment of their own, $warnings warnings"
cat $out/api.log >&2
/usr/bin/python3 docs/site/check.py $out/site
echo "$out/site/index.html"
[[ $warnings -eq 0 ]]
