; check: exit 1
; error 20816 at 3:5
G74 X99999999999
M30
