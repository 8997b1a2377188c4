; check: exit 1
; error 21867 at 3:3
S[FOO]
M30
