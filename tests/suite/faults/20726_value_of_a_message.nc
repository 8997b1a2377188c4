; check: exit 1
; error 20726 at 4:7
; error 20726 at 5:13
#MSG ["WERT1=%D WERT2=%D", 10]
#MSG ["%D", , 5]
M30
