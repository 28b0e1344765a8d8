import { notifications } from '@mantine/notifications';
import { t } from '@/i18n';

/** Copies an address, and confirms with a text; if the browser denies the clipboard, the address is shown. */
export async function copyLink(address: string, note: string): Promise<void> {
  try {
    await navigator.clipboard.writeText(address);
    notifications.show({ title: t('axis:link.copied'), message: note });
  } catch {
    notifications.show({
      color: 'yellow',
      title: t('axis:link.notCopied'),
      message: address,
      autoClose: false,
      styles: { description: { overflowWrap: 'anywhere', userSelect: 'all' } },
    });
  }
}

/** Copies a text, and says so; the browser may deny the clipboard. */
export async function copyText(
  text: string,
  says: { readonly done: string; readonly failed: string },
): Promise<void> {
  try {
    await navigator.clipboard.writeText(text);
    notifications.show({ message: says.done });
  } catch {
    notifications.show({ color: 'yellow', message: says.failed });
  }
}
