"""The yardstick: the direct recurrences, written by hand for one equation each, on FLINT's ``fmpq_poly``.

Order by order, Fourier polynomials in z = exp(i tau), solvability at each order; nothing general about them.  A
Fourier polynomial of highest harmonic h is stored as z^h times itself.
"""

from __future__ import annotations

from flint import fmpq, fmpq_poly


def pendulum(order: int) -> list[fmpq]:
    """omega0(A) of u'' + sin u = 0 through A^order, peak amplitude; u_n is stored times z^n."""
    half = fmpq(1, 2)
    zero = fmpq_poly([])
    u = [zero, fmpq_poly([half, 0, half])]
    sine, cosine = [zero, u[1]], [fmpq_poly([1]), zero]
    w = [fmpq(1)]
    for n in range(2, order + 2):
        # n s_n = sum j u_j c_(n-j) without the part u_n c_0;  n c_n = -sum j u_j s_(n-j)
        s = sum((j * u[j] * cosine[n - j] for j in range(1, n) if n % 2 and j % 2), zero) * fmpq(1, n)
        right = s + sum((w[j] * curvature(u[n - j], n - j).left_shift(j) for j in range(2, n - 1, 2)), zero)
        new, resonant = solve(-right, n)
        w.append(2 * resonant)  # w u_1'' adds -w/2 to the first harmonic of the left-hand side
        w[-1] = -w[-1]
        at_zero = sum(new.coeffs(), fmpq(0))
        new -= fmpq_poly([0] * (n - 1) + [at_zero * half, 0, at_zero * half])
        u.append(new)
        sine.append(s + new)
        c = sum((j * u[j] * sine[n - j] for j in range(1, n) if n % 2 == 0 and j % 2), zero) * fmpq(-1, n)
        cosine.append(c)
    return square_root(w)


def van_der_pol(order: int) -> list[fmpq]:
    """omega0(eps) of u'' - eps (1 - u^2) u' + u = 0; u_n is stored times i^n z^(2n+1), so that it is real.

    With eps -> i eps the equation reads omega^2 u'' + u = -eps (1 - u^2) v, v = omega D u, D = -i d/dtau: all real.
    """
    zero = fmpq_poly([])
    u = [fmpq_poly([1, 0, 1])]
    velocity, square = [slope(u[0], 1)], [u[0] * u[0]]
    w, omega = [fmpq(1)], [fmpq(1)]
    for n in range(1, order + 2):
        m = n - 1
        settled = sum((square[j] * velocity[m - j] for j in range(1, m)), zero)
        settled += sum((w[j] * curvature(u[n - j], 2 * (n - j) + 1).left_shift(2 * j) for j in range(2, n)), zero)
        right = latest(u, velocity, square, w, n) - settled
        excess = (right[2 * n] - right[2 * n + 2]) / 2
        if excess:  # a secular sine: a_(n-1) cos tau in u_(n-1) removes it, whose slope is 1 here
            change = fmpq_poly([0] * (2 * m) + [-excess / 2, 0, -excess / 2])
            u[m] += change
            velocity[m] += slope(change, 2 * m + 1)
            square[m] += 2 * change * u[0]
            right = latest(u, velocity, square, w, n) - settled
        if right[2 * n] != right[2 * n + 2]:
            raise AssertionError("the secular term did not vanish")
        new, resonant = solve(right, 2 * n + 1)
        w.append(-resonant)
        omega.append((w[n] - sum((omega[j] * omega[n - j] for j in range(1, n)), fmpq(0))) / 2)
        if n % 2:  # u'(0) = 0 by a multiple of sin tau
            tilt = sum(((k - 2 * n - 1) * c for k, c in enumerate(new.coeffs())), fmpq(0)) / 2
            new += fmpq_poly([0] * (2 * n) + [tilt, 0, -tilt])
        u.append(new)
        velocity.append(
            sum((omega[j] * slope(u[n - j], 2 * (n - j) + 1).left_shift(2 * j) for j in range(n + 1)), zero)
        )
        square.append(sum((u[j] * u[n - j] for j in range(n + 1)), zero))
    return [(-1) ** (n // 2) * c for n, c in enumerate(omega[: order + 1])]  # back from i eps


def latest(u: list, velocity: list, square: list, w: list[fmpq], n: int) -> fmpq_poly:
    """The part of the right-hand side of order n that holds u_(n-1)."""
    m = n - 1
    right = velocity[m].left_shift(2) - square[0] * velocity[m]
    if m:
        right -= square[m] * velocity[0] + w[1] * curvature(u[m], 2 * m + 1).left_shift(2)
    return right


def slope(p: fmpq_poly, h: int) -> fmpq_poly:
    """-i d/dtau of z^-h p."""
    return fmpq_poly([(k - h) * c for k, c in enumerate(p.coeffs())])


def curvature(p: fmpq_poly, h: int) -> fmpq_poly:
    """d^2/dtau^2 of z^-h p."""
    return fmpq_poly([-((k - h) ** 2) * c for k, c in enumerate(p.coeffs())])


def solve(right: fmpq_poly, h: int) -> tuple[fmpq_poly, fmpq]:
    """w'' + w = right harmonic by harmonic; also the resonant coefficient (mean of both sides)."""
    values = right.coeffs()
    new = [c / (1 - (k - h) ** 2) if abs(k - h) != 1 else fmpq(0) for k, c in enumerate(values)]
    resonant = (right[h - 1] + right[h + 1]) / 2
    return fmpq_poly(new), resonant


def square_root(w: list[fmpq]) -> list[fmpq]:
    """omega from omega^2."""
    omega = [fmpq(1)]
    for n in range(1, len(w)):
        omega.append((w[n] - sum((omega[j] * omega[n - j] for j in range(1, n)), fmpq(0))) / 2)
    return omega
