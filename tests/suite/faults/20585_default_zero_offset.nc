; check --set zero.default_index=200: exit 2
; error 20585 at --set 1:1
M30
