; check: exit 1
; error 20107 at 3:1
G99999
M30
