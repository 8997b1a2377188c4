; check: exit 1
; error 21281 at 3:93
#SET AX LINK [1, C=X, C=X, C=X, C=X, C=X, C=X, C=X, C=X, C=X, C=X, C=X, C=X, C=X, C=X, C=X, C=X]
M30
