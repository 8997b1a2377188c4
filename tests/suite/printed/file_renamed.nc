; check: exit 1
; page 207511947 another name of a file (#FILE RENAME)
; error K-0019 at 4:1
#FILE RENAME [PATHOLD="a.nc" PATHNEW="b.nc" OVRMODE=1]
M30
