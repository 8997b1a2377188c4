; check: exit 1
; error 20675 at 3:11
#CS ON [1,FOO]
M30
