; check: exit 1
; error 21471 at 3:7
V.P.T=LEFT["Hello world!"]
M30
