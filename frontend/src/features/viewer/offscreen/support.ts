let known: boolean | null = null;

/** Returns whether a worker of this browser can draw in 3D on a canvas of the page. */
export function canDrawInWorker(): boolean {
  known ??= probe();
  return known;
}

function probe(): boolean {
  if (typeof OffscreenCanvas === 'undefined' || typeof Worker === 'undefined') return false;
  if (!('transferControlToOffscreen' in HTMLCanvasElement.prototype)) return false;
  const gl = new OffscreenCanvas(1, 1).getContext('webgl2');
  gl?.getExtension('WEBGL_lose_context')?.loseContext();
  return gl !== null;
}
