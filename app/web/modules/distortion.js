// Distortion: a polynomial map of the plane, and its inverse. The same map as
// renderer/camera/distortion.py, for one point at a time.

/** @typedef {[number, number]} Point */

const FARTHEST_RADIUS = 1e8; // on the image plane, for maps that never fold
const NEWTON_STEPS = 60;
const NOWHERE = /** @type {Point} */ ([NaN, NaN]);

/** Return the value of a polynomial. @param {number[]} p @param {number} x */
const value = (p, x) => p.reduceRight((sum, coefficient) => sum * x + coefficient, 0);

/** @param {number[]} p */
const derivative = (p) => p.slice(1).map((coefficient, k) => (k + 1) * coefficient);

/** @param {number[]} p @param {number[]} q */
function product(p, q) {
  const result = new Array(Math.max(p.length + q.length - 1, 0)).fill(0);
  p.forEach((a, i) => q.forEach((b, j) => (result[i + j] += a * b)));
  return result;
}

/** Return the positive roots of a polynomial, between those of its derivative. @param {number[]} p @returns {number[]} */
function positiveRoots(p) {
  let last = p.length - 1;
  while (last > 0 && p[last] === 0) last -= 1;
  if (last <= 0) return [];
  const trimmed = p.slice(0, last + 1);
  const bound = 1 + Math.max(...trimmed.map((c) => Math.abs(c / trimmed[last])));
  const ends = [0, ...positiveRoots(derivative(trimmed)).filter((x) => x < bound), bound];
  const roots = [];
  for (let k = 1; k < ends.length; k += 1) {
    let low = ends[k - 1], high = ends[k];
    const rises = value(trimmed, low) < 0;
    if (rises === value(trimmed, high) < 0) continue;
    for (let n = 0; n < 200 && low < high; n += 1) {
      const middle = (low + high) / 2;
      if (middle === low || middle === high) break;
      if (value(trimmed, middle) < 0 === rises) low = middle;
      else high = middle;
    }
    roots.push(high);
  }
  return roots;
}

/** Radial, tangential and thin-prism distortion of the plane: a polynomial map, and its inverse. */
export class Distortion {
  /**
   * @param {number[]} above @param {number[]} below polynomials in r^2, whose quotient scales a point
   * @param {number} p1 @param {number} p2 @param {number[]} prism @param {number} widest
   */
  constructor(above, below, p1, p2, prism, widest) {
    this.above = above;
    this.below = below;
    this.p1 = p1;
    this.p2 = p2;
    this.prism = prism;
    this.above1 = derivative(above);
    this.below1 = derivative(below);
    // The radius at which r above(r^2) / below(r^2) stops rising.
    const [q, r] = [product(this.above1, below), product(above, this.below1)];
    const slope = Array.from({ length: Math.max(q.length, r.length) }, (_, k) => (q[k] || 0) - (r[k] || 0));
    const rising = product(above, below);
    slope.forEach((c, k) => (rising[k + 1] = (rising[k + 1] || 0) + 2 * c));
    const first = Math.min(Infinity, ...positiveRoots(rising), ...positiveRoots(below));
    this.end = Math.min(widest, Math.sqrt(first));
    this.isRadial = !(p1 || p2 || prism.some((s) => s));
    this.folds = this.isRadial ? [] : this.foldRadii();
  }

  /** Return the radii at which the map first folds, at 721 angles from -pi to pi. */
  foldRadii() {
    const farthest = Math.min(this.end, FARTHEST_RADIUS);
    const start = Math.log(1e-6 / (1 + farthest));
    const radii = Array.from({ length: 512 }, (_, k) => farthest * Math.exp(start * (1 - k / 511)));
    return Array.from({ length: 721 }, (_, n) => {
      const c = Math.cos(-Math.PI + (n / 720) * 2 * Math.PI), s = Math.sin(-Math.PI + (n / 720) * 2 * Math.PI);
      /** @param {number} r */
      const isFolded = (r) => this.determinant(r * c, r * s) <= 0;
      const k = radii.findIndex(isFolded);
      if (k < 0) return farthest;
      let low = k > 0 ? radii[k - 1] : 0, high = radii[k];
      for (let step = 0; step < 50; step += 1) {
        const middle = (low + high) / 2;
        if (isFolded(middle)) high = middle;
        else low = middle;
      }
      return high;
    });
  }

  /** @param {number} x @param {number} y */
  endAt(x, y) {
    if (this.isRadial) return this.end;
    const place = ((Math.atan2(y, x) + Math.PI) / (2 * Math.PI)) * 720;
    const k = Math.min(Math.floor(place), 719);
    return this.folds[k] + (place - k) * (this.folds[k + 1] - this.folds[k]);
  }

  /** @param {number} x @param {number} y @returns {Point} */
  map(x, y) {
    const s = x * x + y * y, radial = value(this.above, s) / value(this.below, s);
    const { p1, p2 } = this, [s1, s2, s3, s4] = this.prism;
    return [
      x * radial + 2 * p1 * x * y + p2 * (s + 2 * x * x) + s1 * s + s2 * s * s,
      y * radial + p1 * (s + 2 * y * y) + 2 * p2 * x * y + s3 * s + s4 * s * s,
    ];
  }

  /** Return the derivatives of the map: of a by x and y, of b by x and y. @param {number} x @param {number} y */
  slopes(x, y) {
    const s = x * x + y * y, above = value(this.above, s), below = value(this.below, s);
    const radial = above / below, { p1, p2 } = this, [s1, s2, s3, s4] = this.prism;
    const slope = (2 * (value(this.above1, s) * below - above * value(this.below1, s))) / below ** 2;
    const prismA = 2 * s1 + 4 * s2 * s, prismB = 2 * s3 + 4 * s4 * s, mixed = slope * x * y;
    return [
      radial + slope * x * x + 2 * p1 * y + 6 * p2 * x + prismA * x,
      mixed + 2 * p1 * x + 2 * p2 * y + prismA * y,
      mixed + 2 * p1 * x + 2 * p2 * y + prismB * x,
      radial + slope * y * y + 6 * p1 * y + 2 * p2 * x + prismB * y,
    ];
  }

  /** @param {number} x @param {number} y */
  determinant(x, y) {
    const [xx, xy, yx, yy] = this.slopes(x, y);
    return xx * yy - xy * yx;
  }

  /** @param {number} x @param {number} y @returns {Point} */
  forward(x, y) {
    return Math.hypot(x, y) <= this.endAt(x, y) ? this.map(x, y) : NOWHERE;
  }

  /** Return the point that is mapped to (a, b). @param {number} a @param {number} b @returns {Point} */
  inverse(a, b) {
    const target = Math.hypot(a, b), radius = this.inverseRadius(target);
    if (this.isRadial) return target > 0 ? [(a * radius) / target, (b * radius) / target] : [a, b];
    const start = Number.isNaN(radius) ? Math.min(this.end, FARTHEST_RADIUS) : radius;
    const scale = target > 0 ? start / target : 0;
    let found = this.newton(a, b, [a * scale, b * scale]);
    if (this.hits(a, b, found)) return found;
    found = [0, 0]; // Near a fold, follow the point outwards from the middle.
    for (let part = 1; part <= 32; part += 1) {
      const at = part / 32;
      found = this.newton(at * a, at * b, found);
      if (!this.hits(at * a, at * b, found)) return NOWHERE;
    }
    return found;
  }

  /** @param {number} a @param {number} b @param {Point} found */
  hits(a, b, [x, y]) {
    const [c, d] = this.map(x, y);
    return Math.hypot(c - a, d - b) < 1e-12 * (1 + Math.hypot(a, b)) && Math.hypot(x, y) <= this.endAt(x, y);
  }

  /** Newton's method in two variables. @param {number} a @param {number} b @param {Point} start @returns {Point} */
  newton(a, b, [x, y]) {
    for (let step = 0; step < NEWTON_STEPS; step += 1) {
      const [atA, atB] = this.map(x, y), [xx, xy, yx, yy] = this.slopes(x, y);
      const da = atA - a, db = atB - b, turned = xx * yy - xy * yx;
      let newX = x - (yy * da - xy * db) / turned, newY = y - (xx * db - yx * da) / turned;
      const within = this.endAt(newX, newY) / Math.max(Math.hypot(newX, newY), 1e-300);
      newX *= Math.min(1, within); // a step out of the lens ends at its border
      newY *= Math.min(1, within);
      const moved = Math.hypot(newX - x, newY - y);
      [x, y] = [newX, newY];
      if (!(moved > 1e-9 * (1e-6 + Math.hypot(x, y)))) break;
    }
    return [x, y];
  }

  /** Newton's method in one variable, within a bracket. @param {number} target */
  inverseRadius(target) {
    /** @param {number} r */
    const radial = (r) => (r * value(this.above, r * r)) / value(this.below, r * r);
    let low = 0, high = Math.min(this.end, FARTHEST_RADIUS);
    if (this.end > FARTHEST_RADIUS) for (high = 1; high < FARTHEST_RADIUS && radial(high) < target; ) high *= 2;
    if (target > radial(high)) return NaN;
    let r = Math.min(target, high);
    for (let step = 0; step < NEWTON_STEPS; step += 1) {
      const s = r * r, above = value(this.above, s), below = value(this.below, s);
      const slope = (value(this.above1, s) * below - above * value(this.below1, s)) / below ** 2;
      const error = (r * above) / below - target;
      if (error > 0) high = r;
      else low = r;
      let next = r - error / (above / below + 2 * s * slope);
      if (!(next >= low && next <= high)) next = (low + high) / 2;
      const moved = Math.abs(next - r);
      r = next;
      if (moved <= 1e-9 * (1e-6 + r)) break;
    }
    return r;
  }
}
