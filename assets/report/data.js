"use strict";
// Data of the page: one compressed block of a JSON head and numeric arrays.

const MAGIC_BYTES = { f4: 4, f8: 8 };

/** Decodes base64 of a deflated block: u32 length of the head, head (JSON), arrays at the offsets the head names. */
async function decodeData(text) {
  const packed = Uint8Array.from(atob(text.trim()), (c) => c.charCodeAt(0));
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate"));
  const bytes = new Uint8Array(await new Response(stream).arrayBuffer());
  const length = new DataView(bytes.buffer).getUint32(0, true);
  const head = JSON.parse(new TextDecoder().decode(bytes.subarray(4, 4 + length)));
  return { head, arrays: bytes.subarray(4 + length) };
}

/** Bytes of an array that are stored by significance: all first bytes, all second bytes ... */
function unshuffle(bytes, size) {
  const count = bytes.length / size;
  const out = new Uint8Array(bytes.length);
  for (let b = 0; b < size; b++) for (let k = 0; k < count; k++) out[k * size + b] = bytes[b * count + k];
  return out;
}

/** The results of a run by path, "campbell/frequency"; arrays are decoded when they are first asked for. */
class Results {
  constructor(root, arrays) {
    this.root = root;
    this.arrays = arrays;
  }

  /** Group of a path, or undefined. */
  group(path) {
    return path.split("/").filter(Boolean).reduce((node, name) => node?.groups?.[name], this.root);
  }

  /** Names of the items below a group: groups with a set or group `marks`; a name with a slash is a path of groups. */
  items(path, ...marks) {
    const inside = (node, name) =>
      Object.entries(node?.groups ?? {}).flatMap(([part, child]) => {
        const full = name ? `${name}/${part}` : part;
        const isItem = marks.some((mark) => child.sets?.[mark] || child.groups?.[mark]);
        return [...(isItem ? [full] : []), ...inside(child, full)];
      });
    return inside(this.group(path), "");
  }

  /** Names of the data sets below a group. */
  setNames(path) {
    const inside = (node, name) => [
      ...Object.keys(node?.sets ?? {}).map((set) => name + set),
      ...Object.entries(node?.groups ?? {}).flatMap(([part, child]) => inside(child, `${name}${part}/`)),
    ];
    return inside(this.group(path), "");
  }

  /** Attribute of a group. */
  attribute(path, name) {
    return this.group(path)?.attributes?.[name];
  }

  /** Data set of a path: { shape, unit, values }, values numbers, texts, or numbers in pairs (re, im). */
  set(path) {
    const cut = path.lastIndexOf("/");
    const set = this.group(path.slice(0, Math.max(cut, 0)))?.sets?.[path.slice(cut + 1)];
    if (set && !set.values) set.values = this.array(set);
    return set;
  }

  values(path) {
    return this.set(path)?.values;
  }

  array({ offset, count, type }) {
    const size = MAGIC_BYTES[type];
    const bytes = unshuffle(this.arrays.subarray(offset, offset + count * size), size);
    return type === "f4" ? new Float32Array(bytes.buffer) : new Float64Array(bytes.buffer);
  }
}

/** Row k of the last dimension of a data set. */
function rowOf(set, k) {
  const length = set.shape[set.shape.length - 1] * (set.complex ? 2 : 1);
  return set.values.slice(k * length, (k + 1) * length);
}

/** Index of the value nearest to x. */
function nearest(values, x) {
  let best = 0;
  for (let k = 1; k < values.length; k++) if (Math.abs(values[k] - x) < Math.abs(values[best] - x)) best = k;
  return best;
}

/** A number with so many significant digits, without trailing zeros. */
function digits(x, count = 5) {
  if (x === null || x === undefined || Number.isNaN(x)) return "–";
  if (!Number.isFinite(x)) return x > 0 ? "∞" : "−∞";
  if (x === 0) return "0";
  const size = Math.abs(x);
  const text = size >= 1e6 || size < 1e-4 ? x.toExponential(count - 1).replace(/\.?0+e/, "e") : String(Number(x.toPrecision(count)));
  return text.replace("-", "−");
}
