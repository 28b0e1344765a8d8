import { flushSync } from 'react-dom';
import { createRoot } from 'react-dom/client';
import type { Diagram } from '@/model/diagram';
import { layoutTree } from '@/model/layout';
import type { Vocabulary } from '@/model/vocabulary';
import { paletteOf, type Theme } from './palette';
import { TreeImage } from './TreeImage';

/** The scale of pictures: two pixels per point look sharp on high-resolution screens and in print. */
const SCALE = 2;
/** The largest canvas in px that browsers accept; larger trees are drawn at a smaller scale. */
const MAX_PIXELS = 8192;

/** Returns a tree as a standalone SVG document. */
export function svgOf(diagram: Diagram, vocabulary: Vocabulary, theme: Theme): string {
  const host = document.createElement('div');
  const root = createRoot(host);
  const layout = layoutTree(diagram, vocabulary);
  flushSync(() => {
    root.render(
      <TreeImage diagram={diagram} layout={layout} vocabulary={vocabulary} palette={paletteOf(theme)} />,
    );
  });
  const drawn = host.querySelector('svg');
  const text = drawn ? new XMLSerializer().serializeToString(drawn) : '';
  root.unmount();
  return `<?xml version="1.0" encoding="UTF-8"?>\n${text}\n`;
}

/** Converts an SVG document to a PNG. */
export async function pngOf(svg: string): Promise<Blob> {
  const image = new Image();
  image.src = `data:image/svg+xml;charset=utf-8,${encodeURIComponent(svg)}`;
  await image.decode();
  const scale = Math.min(SCALE, MAX_PIXELS / image.naturalWidth, MAX_PIXELS / image.naturalHeight);
  const canvas = document.createElement('canvas');
  canvas.width = Math.round(image.naturalWidth * scale);
  canvas.height = Math.round(image.naturalHeight * scale);
  canvas.getContext('2d')?.drawImage(image, 0, 0, canvas.width, canvas.height);
  return new Promise((resolve, reject) => {
    canvas.toBlob((blob) => (blob ? resolve(blob) : reject(new Error('The picture is empty.'))), 'image/png');
  });
}

/** Starts the download of data that the page has made. */
export function saveAs(blob: Blob, filename: string): void {
  const url = URL.createObjectURL(blob);
  const link = document.createElement('a');
  link.href = url;
  link.download = filename;
  link.click();
  // The download reads the URL after the click has returned.
  setTimeout(() => URL.revokeObjectURL(url), 60_000);
}
