import { MantineProvider } from '@mantine/core';
import { QueryClientProvider } from '@tanstack/react-query';
import { StrictMode } from 'react';
import { createRoot } from 'react-dom/client';
import { queries } from './api/queries';
import { t } from './i18n';
import './ui/global.css';
import { stylesArrive } from '@/ui/parts';
import { colorSchemeManager, cssVariablesResolver, theme } from '@/ui/theme';
import { App } from './App';

/**
 * Starts the page when its style sheets are loaded, since it is unusable without them. If they fail, it shows
 * an error that needs no style sheet.
 */
async function start(root: HTMLElement): Promise<void> {
  try {
    await stylesArrive();
  } catch {
    root.textContent = `${t('frame:missing.title')}. ${t('frame:missing.text')} `;
    const again = document.createElement('button');
    again.textContent = t('frame:crash.reload');
    again.onclick = () => {
      window.location.reload();
    };
    root.append(again);
    return;
  }
  createRoot(root).render(
    <StrictMode>
      <QueryClientProvider client={queries}>
        <MantineProvider
          theme={theme}
          cssVariablesResolver={cssVariablesResolver}
          colorSchemeManager={colorSchemeManager}
          defaultColorScheme="auto"
        >
          <App />
        </MantineProvider>
      </QueryClientProvider>
    </StrictMode>,
  );
}

const root = document.getElementById('root');
if (root) void start(root);
