; check: exit 1
; error 21629 at 3:9
#SLOPE [TYPE=FOO]
M30
