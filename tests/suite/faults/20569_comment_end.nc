; check: exit 1
; error 20569 at 4:1
#COMMENT BEGIN
#COMMENT END X1
M30
