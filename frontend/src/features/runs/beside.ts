/** Opens a page of this site in a window of its own, which has the right half of the screen. */
export function openBeside(path: string): void {
  const { availWidth, availHeight } = window.screen;
  const half = Math.round(availWidth / 2);
  const features = `popup,noopener,left=${half},top=0,width=${half},height=${availHeight}`;
  window.open(path, '_blank', features);
}
