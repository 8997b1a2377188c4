; check: exit 1
; error 21472 at 3:28
V.P.T=LEFT["Hello world!", 100000]
M30
