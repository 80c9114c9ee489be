// What the rasterizer keeps on the GPU: programs, arrays as textures, framebuffers.

/** @typedef {import("./camera.js").Size} Size */
/** @typedef {{texture: WebGLTexture, framebuffer: WebGLFramebuffer, size: Size, depth: WebGLRenderbuffer}} Target */

const TABLE_WIDTH = 1 << 11; // TABLE_SHIFT in app/web/glsl.py
/** The textures that shaders read, each with a unit of its own. */
const UNITS = ["triangle_rows", "spheres", "objects", "lights", "faces", "vertices", "texels", "textures", "uv", "primitives", "positions"];

/** Return a program; throw an Error with the driver's words. @param {WebGL2RenderingContext} gl @param {[string, string]} sources vertex and fragment shader */
export function linkProgram(gl, [vertex, fragment]) {
  const program = gl.createProgram();
  for (const [kind, source] of /** @type {[number, string][]} */ ([[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]])) {
    const shader = /** @type {WebGLShader} */ (gl.createShader(kind));
    gl.shaderSource(shader, source);
    gl.compileShader(shader);
    if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS) && !gl.isContextLost()) throw new Error(`shader: ${gl.getShaderInfoLog(shader)}`);
    gl.attachShader(program, shader);
  }
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS) && !gl.isContextLost()) throw new Error(`shaders: ${gl.getProgramInfoLog(program)}`);
  gl.useProgram(program);
  UNITS.forEach((name, unit) => gl.uniform1i(gl.getUniformLocation(program, name), unit));
  const block = gl.getUniformBlockIndex(program, "Camera");
  if (block !== gl.INVALID_INDEX) gl.uniformBlockBinding(program, block, 0);
  return program;
}

/** Arrays as textures that shaders index, and framebuffers, by name. */
export class GpuStore {
  /** @param {WebGL2RenderingContext} gl */
  constructor(gl) {
    this.gl = gl;
    /** @type {Map<string, {texture: WebGLTexture, array: Float32Array | Int32Array}>} */
    this.tables = new Map();
    /** @type {Map<string, Target>} */
    this.targets = new Map();
  }

  /** Bind a texture to the unit of its name. @param {string} name @param {WebGLTexture} texture */
  bind(name, texture) {
    const { gl } = this;
    gl.activeTexture(gl.TEXTURE0 + UNITS.indexOf(name));
    gl.bindTexture(gl.TEXTURE_2D, texture);
  }

  /** Return a new texture, bound to the unit of a name. @param {string} name */
  newTexture(name) {
    const { gl } = this, texture = gl.createTexture();
    this.bind(name, texture);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
    return texture;
  }

  /**
   * Store an array as a texture, row by row.
   * @param {string} name @param {Float32Array | Int32Array} array @param {1 | 2 | 4} parts of a texel
   * @param {Size} [size] the texture's; by default one that the array fits in
   */
  table(name, array, parts, size) {
    const { gl } = this, isWhole = array instanceof Int32Array;
    const [width, height] = size ?? [TABLE_WIDTH, Math.max(1, Math.ceil(array.length / parts / TABLE_WIDTH))];
    const room = width * height * parts;
    let table = this.tables.get(name);
    if (!table || table.array.length !== room) {
      if (table) gl.deleteTexture(table.texture);
      table = { texture: this.newTexture(name), array: isWhole ? new Int32Array(room) : new Float32Array(room) };
      this.tables.set(name, table);
    }
    table.array.set(array);
    const [internal, format] = {
      1: [gl.R32I, gl.RED_INTEGER],
      2: [gl.RG32F, gl.RG],
      4: isWhole ? [gl.RGBA32I, gl.RGBA_INTEGER] : [gl.RGBA32F, gl.RGBA],
    }[parts];
    this.bind(name, table.texture);
    gl.texImage2D(gl.TEXTURE_2D, 0, internal, width, height, 0, format, isWhole ? gl.INT : gl.FLOAT, table.array);
  }

  /**
   * Return a framebuffer of colours or of primitives' numbers, and use it.
   * @param {string} name @param {Size} size @param {boolean} isColor @returns {Target}
   */
  target(name, size, isColor) {
    const { gl } = this, old = this.targets.get(name);
    if (old && old.size[0] === size[0] && old.size[1] === size[1]) {
      gl.bindFramebuffer(gl.FRAMEBUFFER, old.framebuffer);
      return old;
    }
    if (old) {
      gl.deleteTexture(old.texture);
      gl.deleteFramebuffer(old.framebuffer);
      gl.deleteRenderbuffer(old.depth);
    }
    const texture = this.newTexture("primitives"), framebuffer = gl.createFramebuffer(), depth = gl.createRenderbuffer();
    gl.texStorage2D(gl.TEXTURE_2D, 1, isColor ? gl.RGBA8 : gl.R32I, ...size);
    gl.bindFramebuffer(gl.FRAMEBUFFER, framebuffer);
    gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, texture, 0);
    gl.bindRenderbuffer(gl.RENDERBUFFER, depth);
    gl.renderbufferStorage(gl.RENDERBUFFER, gl.DEPTH_COMPONENT24, ...size);
    gl.framebufferRenderbuffer(gl.FRAMEBUFFER, gl.DEPTH_ATTACHMENT, gl.RENDERBUFFER, depth);
    const made = { texture, framebuffer, size, depth };
    this.targets.set(name, made);
    return made;
  }
}
