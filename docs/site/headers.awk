# What stands above a header's namespace is about the header.
/^\/\/\// { held = held $0 "\n"; next }
{ if (/^namespace/ && held != "") printf "/// \\file\n"; printf "%s", held; held = ""; print }
END { printf "%s", held }
