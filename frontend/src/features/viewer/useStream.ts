import { useEffect, useRef } from 'react';
import type { StreamName } from '@/generated/messages';
import { streams, type StreamHandle, type StreamOptions } from '@/store/session/streams';

/**
 * Subscribes to a stream, or to a camera by name, while `isWanted`; returns a reference whose `update`
 * changes the options.
 */
export function useStream(
  stream: StreamName,
  isWanted: boolean,
  options: StreamOptions,
  sensor?: string,
): { readonly current: StreamHandle | null } {
  const handle = useRef<StreamHandle | null>(null);
  const { max_hz, width } = options;
  const first = useRef(options);
  useEffect(() => {
    if (!isWanted) return;
    const wanted: StreamOptions = { ...first.current };
    if (max_hz !== undefined) wanted.max_hz = max_hz;
    if (width !== undefined) wanted.width = width;
    const made = streams.want(stream, wanted, sensor);
    handle.current = made;
    return () => {
      handle.current = null;
      made.release();
    };
  }, [stream, sensor, isWanted, max_hz, width]);
  return handle;
}
