; check: exit 1
; error 21710 at 3:10
#MSG SYN SYN ["text"]
M30
