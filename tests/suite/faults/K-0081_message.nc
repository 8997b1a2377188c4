; run: exit 0
; note K-0081 at -
#MSG ["hello"]
M30
