; check: exit 1
; error 20721 at 4:7
; error 20721 at 5:17
#MSG ["WERT1=%D WERT2=%D", 10]
#MSG ["%D", 10, 5]
M30
