/** Reads a file that lies beside another one, by the name that it has there; rejects if there is none. */
export type Beside = (name: string) => Promise<ArrayBuffer>;

/** A glTF document, and its buffers: its reader would fetch them, which the page's policy forbids for `data:`. */
export interface Whole {
  readonly document: string;
  readonly buffers: readonly ArrayBuffer[];
}

/** Reads the buffers of a glTF document; its looks, which would be fetched for nothing, are gone. */
export async function selfContained(text: string, beside: Beside): Promise<Whole> {
  const {
    images: _images,
    textures: _textures,
    materials: _materials,
    ...tree
  } = JSON.parse(text) as Record<string, unknown>;
  const buffers = await Promise.all(
    ((tree['buffers'] ?? []) as { uri?: string }[]).map(({ uri }, index) => {
      if (uri === undefined) throw new Error(`buffer ${index} has no uri`);
      return uri.startsWith('data:') ? heldIn(uri) : beside(decodeURIComponent(uri));
    }),
  );
  // A primitive without material has the default one.
  const document = JSON.stringify(tree, (key, value: unknown) => (key === 'material' ? undefined : value));
  return { document, buffers };
}

/** Returns the bytes that a `data:` URI holds. */
function heldIn(uri: string): ArrayBuffer {
  const comma = uri.indexOf(',');
  const content = uri
    .slice(comma + 1)
    .replace(/%([0-9a-f]{2})/gi, (_, byte: string) => String.fromCharCode(parseInt(byte, 16)));
  const letters = uri.slice(0, comma).endsWith(';base64') ? atob(content) : content;
  return Uint8Array.from(letters, (letter) => letter.charCodeAt(0)).buffer;
}
