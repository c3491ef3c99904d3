"""
Series against the exact frequency
==================================

No order helps beyond the radius of convergence, here where the restoring force vanishes.
"""

import matplotlib.pyplot as plt
import numpy as np

import ridgeback

equation = "u'' + u - u**3 = 0"
inside = np.linspace(0.02, 0.98, 25)
exact = [float(ridgeback.enclose(equation, f"{a:.2f}").omega) for a in inside]
figure, axes = plt.subplots()
for order in (2, 4, 8, 16):
    axes.plot(inside, ridgeback.derive(equation, order)(inside), label=f"order {order}")
axes.plot(inside, exact, "k.", label="exact, enclosed")
axes.set_xlabel("peak amplitude A")
axes.set_ylabel("omega0, rad per time unit")
axes.legend()
