let known: { isAvailable: boolean; isSoftware: boolean } | null = null;

function probe(): { isAvailable: boolean; isSoftware: boolean } {
  // A worker has no document.
  const canvas =
    typeof document === 'undefined' ? new OffscreenCanvas(1, 1) : document.createElement('canvas');
  const gl = canvas.getContext('webgl2') as WebGL2RenderingContext | null;
  if (!gl) return { isAvailable: false, isSoftware: false };
  const info = gl.getExtension('WEBGL_debug_renderer_info');
  const renderer = String(
    info ? gl.getParameter(info.UNMASKED_RENDERER_WEBGL) : gl.getParameter(gl.RENDERER),
  );
  gl.getExtension('WEBGL_lose_context')?.loseContext();
  return { isAvailable: true, isSoftware: /swiftshader|llvmpipe|software|basic render/i.test(renderer) };
}

export function hasWebGl(): boolean {
  known ??= probe();
  return known.isAvailable;
}

/**
 * Returns whether WebGL is drawn by the processor: then views draw fewer frames and no shadows, so that the
 * simulation keeps its cores.
 */
export function isSoftwareWebGl(): boolean {
  known ??= probe();
  return known.isSoftware;
}
