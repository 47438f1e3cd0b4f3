/** Opens the system's file dialog. */

/** `accept` as in `<input type="file">`. Nothing is called when the dialog is cancelled. */
export function pickFile(accept: string, onFile: (file: File) => void): void {
  const input = document.createElement('input');
  input.type = 'file';
  input.accept = accept;
  input.addEventListener('change', () => {
    const [file] = input.files ?? [];
    if (file) onFile(file);
  });
  input.click();
}

/** What a portrait may be; the server looks at the content, not at the name. */
export const PICTURES = 'image/*,.tif,.tiff,.bmp';
export const PROJECTS = '.vtalk';
